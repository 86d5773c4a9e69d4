#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "nonet/math/random.h"
#include "nonet/protocol/effectors.h"
#include "nonet/protocol/percept_text.h"
#include "nonet/protocol/rounding.h"
#include "nonet/protocol/sexpr_reader.h"

namespace nonet::protocol {
namespace {

std::string printed(const char* format, double value) {
  std::array<char, 512> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

double readNumber(const std::string& text) {
  SexprReader reader(text);
  double value = 12345.0;
  EXPECT_TRUE(reader.number(value)) << text;
  EXPECT_TRUE(reader.atEnd()) << text;
  return value;
}

void expectSameBits(double actual, double expected, const std::string& text) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(actual), std::bit_cast<std::uint64_t>(expected))
      << text << ": " << actual << " and " << expected;
}

// Floats of all magnitudes, those that lie on or next to a tie of the second decimal among them.
float anyFloat(Random& random) {
  switch (random.below(4)) {
    case 0:
      return std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
    case 1:
      return static_cast<float>(random.uniform(-180.0, 180.0));
    case 2:
      return static_cast<float>(static_cast<double>(random.below(4000)) - 2000.0) / 8.0F;  // .125: a tie
    default:
      return static_cast<float>((static_cast<double>(random.below(4000)) - 2000.0) / 100.0 + 0.005);
  }
}

// The oracle is C: printf as the server does, strtod as the definition of the value of a text.
TEST(Numbers, RoundToWireIsPrintfAndStrtod) {
  Random random(1);
  for (int i = 0; i < 200000; ++i) {
    const float value = anyFloat(random);
    const std::string text = printed("%.2f", static_cast<double>(value));
    const double expected = std::strtod(text.c_str(), nullptr);
    if (std::isnan(value)) {
      EXPECT_TRUE(std::isnan(roundToWire(value)));
      EXPECT_EQ(std::signbit(roundToWire(value)), std::signbit(expected));
    } else {
      expectSameBits(roundToWire(value), expected, text);
    }
    expectSameBits(roundToWire(value), readNumber(text), text);
  }
}

// What the simulation passes on in process is what an agent reads from the text.
TEST(Numbers, InProcessAnglesEqualReadAngles) {
  Random random(2);
  for (int i = 0; i < 50000; ++i) {
    const float degrees = anyFloat(random);
    Percept percept;
    parsePercept("(HJ (n hj1) (ax " + printed("%.2f", static_cast<double>(degrees)) + "))", percept);
    ASSERT_EQ(percept.unknownTokens, 0);
    expectSameBits(percept.joints[0], radiansOnWire(degrees), std::to_string(degrees));
  }
}

TEST(Numbers, SexprNumbersAreThoseOfStrtod) {
  Random random(3);
  for (int i = 0; i < 200000; ++i) {
    std::string text = random.below(2) == 0 ? "-" : "";
    for (std::uint64_t digits = random.below(20); digits > 0; --digits) {
      text += static_cast<char>('0' + random.below(10));
    }
    text += random.below(3) == 0 ? "" : ".";
    for (std::uint64_t digits = random.below(20); digits > 0; --digits) {
      text += static_cast<char>('0' + random.below(10));
    }
    if (random.below(5) == 0) {
      text += "e" + std::to_string(static_cast<int>(random.below(40)) - 20);
    }
    if (text.find_first_of("0123456789") >= std::min(text.find('e'), text.size())) {
      continue;  // no digit before the exponent: not a number
    }
    expectSameBits(readNumber(text), std::strtod(text.c_str(), nullptr), text);
  }
}

TEST(Numbers, WhatIsNotANumber) {
  for (const std::string text :
       {"", "-", ".", "-.", "1.2.3", "1x", "x1", "--1", "+1", "1e", "1-", "(1)", "1e999"}) {
    SexprReader reader(text);
    double value = 0.0;
    EXPECT_FALSE(reader.number(value)) << text;
    int integer = 0;
    EXPECT_FALSE(reader.integer(integer)) << text;
  }
  expectSameBits(readNumber("-0.00"), -0.0, "-0.00");
  EXPECT_TRUE(std::isnan(readNumber("nan")) && !std::signbit(readNumber("nan")));
  EXPECT_TRUE(std::isnan(readNumber("-nan")) && std::signbit(readNumber("-nan")));
  EXPECT_EQ(readNumber("-inf"), -std::numeric_limits<double>::infinity());
}

TEST(Numbers, SixDigitsArePrintfAndStrtod) {
  Random random(4);
  for (int i = 0; i < 200000; ++i) {
    double value = 0.0;
    switch (random.below(4)) {
      case 0:
        value = std::bit_cast<double>(random.next());
        break;
      case 1:
        value = random.uniform(-7.0, 7.0);
        break;
      case 2:  // next to a tie of the sixth digit
        value =
            (static_cast<double>(random.below(2000000)) + 0.5) * std::pow(10.0, random.uniform(-9.0, 3.0));
        break;
      default:
        value = static_cast<double>(random.below(4000000)) / 2.0 * 1e-5;
    }
    const std::string text = printed("%.6g", value);
    if (std::isnan(value)) {
      EXPECT_EQ(std::signbit(roundToSixDigits(value)), std::signbit(value));
      continue;
    }
    expectSameBits(roundToSixDigits(value), std::strtod(text.c_str(), nullptr), text);
    Effectors effectors;
    effectors.setSpeed(model::JointId::Head1, value);
    std::string written;
    writeEffectors(effectors, written);
    EXPECT_EQ(written, "(he1 " + text + ")");
  }
}

}  // namespace
}  // namespace nonet::protocol
