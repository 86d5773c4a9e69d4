#include <gtest/gtest.h>

#include "nonet/math/random.h"

#include "golden.h"
#include "round_trip_properties.h"

namespace nonet::protocol {
namespace {

TEST(RoundTrip, EveryGoldenPerceptComesBackByteForByte) {
  const auto lines = goldenLines(LogLine::Kind::Received);
  ASSERT_GT(lines.size(), 150U);
  Percept percept;  // one for all, as the agent has it: nothing may be left over from the message before
  std::string written;
  for (const std::string& line : lines) {
    parsePercept(line, percept);
    EXPECT_EQ(percept.unknownTokens, 0) << line;
    writePercept(percept, written);
    EXPECT_EQ(written, line);
  }
}

TEST(RoundTrip, EveryGoldenAnswerIsUnderstood) {
  const auto lines = goldenLines(LogLine::Kind::Sent);
  ASSERT_GT(lines.size(), 100U);
  Effectors effectors;
  Effectors again;
  std::string written;
  for (const std::string& line : lines) {
    EXPECT_EQ(parseEffectors(line, effectors), 0) << line;
    writeEffectors(effectors, written);
    // The recorded players write the joints in another order, so the texts agree in length, not in bytes.
    EXPECT_EQ(written.size(), line.size()) << written << "\n" << line;
    EXPECT_EQ(parseEffectors(written, again), 0);
    EXPECT_EQ(difference(effectors, again), "") << line;
  }
}

// Forms that the recordings lack: toes, other play modes, hearing without labels, broken numbers.
TEST(RoundTrip, FormsThatWereNotRecorded) {
  for (const std::string_view line : {
           "(GS (unum 9) (team left) (sl 2) (sr 11) (t 599.98) (pm direct_free_kick_left))",
           "(GS (t 0.00) (pm pass_right))",
           "(FRP (n rf1) (c -0.01 0.02 -0.00) (f 1.00 -2.00 3.00))(HJ (n rlj7) (ax 12.34))",
           "(FRP (n lf1) (c nan -nan inf) (f -inf 0.00 -0.00))(HJ (n llj7) (ax -nan))",
           "(hear 12.34 self abc)(hear 12.34 -170.05 a\"b;c'd)(hear Red 0.02 0.00 x)",
           "(See )",
           "(See (P (team A-b_1) (id 11)))",
           "(See (L (pol 0.10 0.00 -0.00) (pol 1.00 180.00 -180.00)) (B (pol 2.00 1.00 -1.00)))",
           "(ACC (n torso) (a 123456789012.34 -12345678.90 100000000000000000000.00))",
       }) {
    Percept percept;
    std::string written;
    parsePercept(line, percept);
    EXPECT_EQ(percept.unknownTokens, 0) << line;
    writePercept(percept, written);
    EXPECT_EQ(written, line);
  }
}

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  // Cuts, copies, overwrites, inserts: one to eight times.
  std::string operator()(std::string text) {
    static constexpr std::string_view kSpice = "()() \t\n'\";.-+0123456789eEnaifPLB\\\0\xff";
    for (std::uint64_t i = 1 + random_.below(8); i > 0 && !text.empty(); --i) {
      const std::size_t at = random_.below(text.size());
      const std::size_t length = random_.below(std::min<std::size_t>(text.size() - at, 40)) + 1;
      const char spice = kSpice[random_.below(kSpice.size())];
      switch (random_.below(5)) {
        case 0:
          text.erase(at, length);
          break;
        case 1:
          text.insert(random_.below(text.size()), text.substr(at, length));
          break;
        case 2:
          text[at] = spice;
          break;
        case 3:
          text.insert(at, 1, spice);
          break;
        default:
          text.resize(random_.below(8) == 0 ? at : text.size());
      }
    }
    return text;
  }

 private:
  Random random_;
};

constexpr int kRounds = 20000;

TEST(ShortFuzz, MutatedPercepts) {
  const auto lines = goldenLines(LogLine::Kind::Received);
  Mutator mutate(7);
  for (int i = 0; i < kRounds; ++i) {
    const std::string text = mutate(lines[static_cast<std::size_t>(i) % lines.size()]);
    ASSERT_EQ(checkPercept(text), "") << text;
  }
}

TEST(ShortFuzz, MutatedAnswers) {
  auto lines = goldenLines(LogLine::Kind::Sent);
  lines.emplace_back(
      R"((init (teamname "a b") (unum 3))(scene rsg/agent/nao/nao_hetero.rsg 4)(say 'x)(beam 1e3 .5 +2))");
  Mutator mutate(8);
  for (int i = 0; i < kRounds; ++i) {
    const std::string text = mutate(lines[static_cast<std::size_t>(i) % lines.size()]);
    ASSERT_EQ(checkEffectors(text), "") << text;
  }
}

TEST(ShortFuzz, AnyQuestionsToTheReader) {
  const auto lines = goldenLines(LogLine::Kind::Received);
  Mutator mutate(9);
  Random random(10);
  for (int i = 0; i < kRounds; ++i) {
    std::string text(random.below(64), '\0');
    for (char& c : text) {
      c = static_cast<char>(random.below(128));
    }
    text += mutate(lines[static_cast<std::size_t>(i) % lines.size()].substr(0, 300));
    ASSERT_EQ(checkReader<SexprDialect::Plain>(text), "") << text;
    ASSERT_EQ(checkReader<SexprDialect::Commands>(text), "") << text;
  }
}

}  // namespace
}  // namespace nonet::protocol
