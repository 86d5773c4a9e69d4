#include "nonet/config/parameters.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "nonet/config/assignment.h"
#include "nonet/config/nearest.h"
#include "nonet/math/angle.h"
#include "nonet/math/random.h"

namespace nonet::config {
namespace {

using testing::HasSubstr;

struct Swing {
  double lift = 0.03;
  double angle = 0.1;
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit({"lift", Unit::Metre, {0.0, 0.2}, search(0.01, 0.1), "Lift of the swing foot"}, self.lift);
    visit({"angle", Unit::Radian, {-3.2, 3.2}, fixed, "Tilt of the swing foot"}, self.angle);
  }
};

struct Example {
  double gain = 1.5;
  int steps = 3;
  bool arms = true;
  double period = 0.24;
  double speed = 0.5;
  double turn = 1.0;
  double brake = 2.0;
  double force = 10.0;
  double mass = 0.2;
  double rate = 50.0;
  Swing swing;
  double wide = 0.0;
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit({"gain", Unit::None, {0.0, 10.0}, fixed, "A gain"}, self.gain);
    visit({"steps", Unit::None, {1, 9}, fixed, "Steps"}, self.steps);
    visit({"arms", Unit::None, {}, fixed, "Whether the arms swing"}, self.arms);
    visit({"period", Unit::Second, {0.02, 1.0}, fixed, "A time"}, self.period);
    visit({"speed", Unit::MetrePerSecond, {-2.0, 2.0}, fixed, "A speed"}, self.speed);
    visit({"turn", Unit::RadianPerSecond, {-7.0, 7.0}, fixed, "A turning speed"}, self.turn);
    visit({"brake", Unit::MetrePerSecondSquared, {0.0, 20.0}, fixed, "An acceleration"}, self.brake);
    visit({"force", Unit::Newton, {0.0, 100.0}, fixed, "A force"}, self.force);
    visit({"mass", Unit::Kilogram, {0.0, 5.0}, fixed, "A mass"}, self.mass);
    visit({"rate", Unit::Hertz, {0.0, 100.0}, fixed, "A frequency"}, self.rate);
    visit.group("swing", self.swing);
    visit({"wide", Unit::None, {-1e308, 1e308}, fixed, "Anything"}, self.wide);
  }
};

struct Whole {
  Example walk;
  double top = 1.0;
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit.group("walk", self.walk);
    visit({"top", Unit::None, {0.0, 2.0}, fixed, "At the top"}, self.top);
  }
};

std::string errorOf(std::string_view toml) {
  Whole parameters;
  try {
    overlayText(parameters, toml, "set.toml");
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Parameters, ListsEveryFieldOnceInOrder) {
  const auto list = listParameters(Whole{});
  ASSERT_EQ(list.size(), 14U);
  EXPECT_EQ(list[0].key, "walk.gain");
  EXPECT_EQ(list[0].value, 1.5);
  EXPECT_EQ(list[1].kind, ParameterView::Kind::Integer);
  EXPECT_EQ(list[2].kind, ParameterView::Kind::Boolean);
  EXPECT_EQ(list[10].key, "walk.swing.lift");
  EXPECT_EQ(list[10].declaration.searchRange->high, 0.1);
  EXPECT_FALSE(list[11].declaration.searchRange.has_value());
  EXPECT_EQ(list[13].key, "top");
}

TEST(Parameters, OverlaysTablesDottedKeysAndInlineTables) {
  Whole parameters;
  overlayText(parameters, "top = 2\n[walk]\nsteps = 5\narms = false\nswing.lift = 0.1\nswing.angle = -1\n",
              "a");
  EXPECT_EQ(parameters.top, 2.0);
  EXPECT_EQ(parameters.walk.swing.angle, -1.0);
  EXPECT_EQ(parameters.walk.steps, 5);
  EXPECT_FALSE(parameters.walk.arms);
  EXPECT_EQ(parameters.walk.swing.lift, 0.1);
  EXPECT_EQ(parameters.walk.gain, 1.5);
  overlayText(parameters, "walk = { gain = 3.5, swing = { lift = \"50mm\" } }", "b");
  EXPECT_EQ(parameters.walk.gain, 3.5);
  EXPECT_EQ(parameters.walk.swing.lift, 0.05);
}

TEST(Parameters, ReadsUnitsToTheLastBit) {
  Whole p;
  overlayText(p,
              "[walk]\nperiod = \"20ms\"\nspeed = \"-1.5 m/s\"\nturn = \"30deg/s\"\nbrake = \"9.81m/s^2\"\n"
              "force = \"2N\"\nmass = \"350g\"\nrate = \"12.5Hz\"\n[walk.swing]\nlift = \"97mm\"\nangle = "
              "\"17deg\"\n",
              "a");
  EXPECT_EQ(p.walk.period, 0.02);
  EXPECT_EQ(p.walk.speed, -1.5);
  EXPECT_EQ(p.walk.turn, toRadians(30.0));
  EXPECT_EQ(p.walk.brake, 9.81);
  EXPECT_EQ(p.walk.force, 2.0);
  EXPECT_EQ(p.walk.mass, 0.35);
  EXPECT_EQ(p.walk.rate, 12.5);
  EXPECT_EQ(p.walk.swing.lift, 0.097);
  EXPECT_EQ(p.walk.swing.angle, toRadians(17.0));
  overlayText(
      p,
      "walk.period = \"0.5s\"\nwalk.speed = \"+35cm/s\"\nwalk.mass = \"1kg\"\nwalk.swing.angle = \"0.5rad\"",
      "a");
  EXPECT_EQ(p.walk.period, 0.5);
  EXPECT_EQ(p.walk.speed, 0.35);
  EXPECT_EQ(p.walk.mass, 1.0);
  EXPECT_EQ(p.walk.swing.angle, 0.5);
}

TEST(Parameters, ErrorsNameFileLineAndRemedy) {
  EXPECT_THAT(errorOf("\n\n[walk]\nstepz = 4\n"),
              testing::AllOf(HasSubstr("set.toml:4:"), HasSubstr("'walk.stepz'"), HasSubstr("'walk.steps'")));
  EXPECT_THAT(errorOf("[walk.swing]\nlift = 0.25\n"),
              testing::AllOf(HasSubstr("set.toml:2:"), HasSubstr("0.25 m"), HasSubstr("0 m .. 0.2 m"),
                             HasSubstr("Lift of the swing foot")));
  EXPECT_THAT(errorOf("[walk.swing]\nlift = \"3deg\"\n"),
              testing::AllOf(HasSubstr("set.toml:2:"), HasSubstr("3deg"), HasSubstr("m, cm, mm")));
  EXPECT_THAT(errorOf("[walk.swing]\nlift = \"mm\"\n"), HasSubstr("set.toml:2:"));
  EXPECT_THAT(errorOf("[walk.swing]\nlift = \"3\"\n"), HasSubstr("m, cm, mm"));
  EXPECT_THAT(errorOf("[walk.swing]\nlift = \"3mm!\"\n"), HasSubstr("m, cm, mm"));
  EXPECT_THAT(errorOf("top = \"1\"\n"),
              testing::AllOf(HasSubstr("set.toml:1:"), HasSubstr("a text"), HasSubstr("a number")));
  EXPECT_THAT(errorOf("top = true\n"), HasSubstr("a switch"));
  EXPECT_THAT(errorOf("walk.steps = 2.5\n"), HasSubstr("whole number"));
  EXPECT_THAT(errorOf("walk.steps = 10\n"), HasSubstr("1 .. 9"));
  EXPECT_THAT(errorOf("walk.arms = 1\n"), HasSubstr("true or false"));
  EXPECT_THAT(errorOf("top = [1.0]\n"), HasSubstr("a list"));
  EXPECT_THAT(errorOf("top = 2001-01-01\n"), HasSubstr("a date"));
  EXPECT_THAT(errorOf("top = nan\n"), HasSubstr("out of range"));
  EXPECT_THAT(errorOf("top = inf\n"), HasSubstr("out of range"));
  EXPECT_THAT(errorOf("[top]\nx = 1\n"), HasSubstr("a table"));
  EXPECT_THAT(errorOf("walk = 1\n"), testing::AllOf(HasSubstr("a group"), HasSubstr("[walk]")));
  EXPECT_THAT(
      errorOf("\n[wlak]\nsteps = 4\n"),
      testing::AllOf(HasSubstr("set.toml:2:"), HasSubstr("unknown table 'wlak'"), HasSubstr("'walk'")));
  EXPECT_THAT(errorOf("lift = 0.1\n"), HasSubstr("'walk.swing.lift'"));  // the group left out
  EXPECT_THAT(errorOf("top = 1\ntop = 2\n"), testing::AllOf(HasSubstr("set.toml:2:"), HasSubstr("not TOML")));
  EXPECT_THAT(errorOf("top = \n"), testing::AllOf(HasSubstr("set.toml:1:"), HasSubstr("not TOML")));
  EXPECT_THAT(errorOf("[[!top]]\n"), testing::AllOf(HasSubstr("set.toml:1:"), HasSubstr("not TOML")));
  EXPECT_THAT(errorOf("top = 1\n\xC3\xB6 = 2\n"),
              testing::AllOf(HasSubstr("set.toml:2:"), HasSubstr("beyond ASCII")));
  EXPECT_THAT(errorOf("provenance = 1\n"), HasSubstr("unknown key"));
}

TEST(Parameters, NothingIsChangedByAFaultyFile) {
  Whole parameters;
  EXPECT_THROW(overlayText(parameters, "top = 0.5\nwalk.gain = 99\n", "a"), ParameterError);
  EXPECT_EQ(parameters.top, 1.0);
  EXPECT_THROW(setParameter(parameters, "top", 3.0), ParameterError);
  EXPECT_EQ(parameters.top, 1.0);
}

TEST(Parameters, ProvenanceIsAllowed) {
  Whole parameters;
  overlayText(parameters, "[provenance]\ntask = \"walk\"\nseed = 7\n[walk]\nsteps = 7\n", "a");
  EXPECT_EQ(parameters.walk.steps, 7);
  EXPECT_THROW(overlayText(parameters, "[walk.provenance]\nseed = 7\n", "a"), ParameterError);
}

TEST(Parameters, SetsByKey) {
  Whole parameters;
  setParameter(parameters, "walk.swing.lift", 0.07);
  setParameter(parameters, "walk.steps", 4.0);
  setParameter(parameters, "walk.arms", 0.0);
  EXPECT_EQ(parameters.walk.swing.lift, 0.07);
  EXPECT_EQ(parameters.walk.steps, 4);
  EXPECT_FALSE(parameters.walk.arms);
  EXPECT_THROW(setParameter(parameters, "walk.steps", 4.5), ParameterError);
  EXPECT_THROW(setParameter(parameters, "walk.arms", 0.5), ParameterError);
  EXPECT_THROW(setParameter(parameters, "walk.swing.lift", std::nan("")), ParameterError);
  try {
    setParameter(parameters, "walk.lift", 0.05);
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'walk.swing.lift'"));
  }
}

// Against setting one by one, in every order of the keys.
TEST(Parameters, SetsManyInAnyOrder) {
  std::vector<std::string> keys = {"walk.arms", "walk.steps", "walk.swing.lift"};
  const std::map<std::string, double> values = {
      {"walk.arms", 0.0}, {"walk.steps", 4.0}, {"walk.swing.lift", 0.07}};
  Whole expected;
  for (const auto& [key, value] : values) setParameter(expected, key, value);
  do {
    std::vector<double> inOrder;
    for (const std::string& key : keys) inOrder.push_back(values.at(key));
    Whole parameters;
    setParameters(parameters, keys, inOrder);
    EXPECT_EQ(toToml(parameters), toToml(expected)) << keys[0] << " " << keys[1];
  } while (std::next_permutation(keys.begin(), keys.end()));
  Whole parameters;
  EXPECT_THROW(setParameters(parameters, std::vector<std::string>{"walk.lift"}, std::vector{0.05}),
               ParameterError);
  EXPECT_THROW(setParameters(parameters, std::vector<std::string>{"walk.steps"}, std::vector{4.5}),
               ParameterError);
}

TEST(Parameters, WritingAndReadingKeepsEveryBit) {
  Random random(5);
  for (int trial = 0; trial < 300; ++trial) {
    Whole written;
    // Any finite bit pattern, and ordinary numbers.
    do {
      written.walk.wide = std::bit_cast<double>(random.next());
    } while (!(std::abs(written.walk.wide) <= 1e308));
    written.walk.swing.angle = random.uniform(-3.2, 3.2);
    written.walk.steps = 1 + static_cast<int>(random.below(9));
    written.walk.arms = random.below(2) == 0;
    written.top = static_cast<double>(random.below(3));
    Whole read;
    overlayText(read, toToml(written), "written");
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read.walk.wide), std::bit_cast<std::uint64_t>(written.walk.wide));
    EXPECT_EQ(read.walk.swing.angle, written.walk.swing.angle);
    EXPECT_EQ(read.walk.steps, written.walk.steps);
    EXPECT_EQ(read.walk.arms, written.walk.arms);
    EXPECT_EQ(read.top, written.top);
    Whole fromDifference;
    overlayText(fromDifference, toTomlDifference(written, Whole{}), "difference");
    EXPECT_EQ(toToml(fromDifference), toToml(written));
  }
}

TEST(Parameters, DifferenceHoldsOnlyWhatDiffers) {
  Whole changed;
  changed.walk.swing.lift = 0.05;
  EXPECT_EQ(toTomlDifference(changed, Whole{}),
            "[walk.swing]\n# Lift of the swing foot (0 m .. 0.2 m)\nlift = 0.05\n");
  EXPECT_EQ(toTomlDifference(Whole{}, Whole{}), "");
  EXPECT_THAT(toToml(Whole{}), HasSubstr("# Whether the arms swing\narms = true\n"));
}

TEST(Parameters, ReadsFilesAndNamesThem) {
  const std::string path =
      testing::TempDir() + "nonet_parameters_test_" + std::to_string(::getpid()) + ".toml";
  std::ofstream(path) << "top = 0.25\n";
  Whole parameters;
  overlayFile(parameters, path);
  EXPECT_EQ(parameters.top, 0.25);
  std::ofstream(path) << "# comment\ntpo = 0.25\n";
  try {
    overlayFile(parameters, path);
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), HasSubstr(path + ":2: unknown key 'tpo': did you mean 'top'?"));
  }
  std::ofstream(path).close();  // empty: no parameter is overlaid
  EXPECT_NO_THROW(overlayFile(parameters, path));
  std::remove(path.c_str());
  try {
    overlayFile(parameters, path);
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr(path), HasSubstr("No such file")));
  }
}

struct Faulty {
  double a = 5.0;
  double b = 0.5;
  int c = 1;
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit({"a", Unit::None, {0.0, 1.0}, fixed, "Default out of range"}, self.a);
    visit({"b", Unit::None, {0.0, 1.0}, search(0.5, 2.0), "Search leaves the range"}, self.b);
    visit({"b", Unit::None, {0.0, 1.0}, fixed, "Twice"}, self.b);
    visit({"c d", Unit::None, {0.0, 1.0}, fixed, ""}, self.c);
    visit({"e", Unit::None, {0.0, 1.0}, fixed, "and then this"}, self.c);
  }
};

TEST(Parameters, DeclarationFaultsAreFound) {
  EXPECT_EQ(declarationFaults(Faulty{}).size(), 6U);
  EXPECT_THAT(declarationFaults(Whole{}), testing::IsEmpty());
}

TEST(Parameters, UnitNames) {
  EXPECT_EQ(unitName(Unit::None), "");
  EXPECT_EQ(unitName(Unit::Metre), "m");
  EXPECT_EQ(unitName(Unit::RadianPerSecond), "rad/s");
  EXPECT_EQ(unitName(Unit::MetrePerSecondSquared), "m/s^2");
}

// One value as people write it; each form once, and what is said to those that fit no form.
TEST(Parameters, AssignmentsTakeEveryFormOfAValue) {
  Example example;
  for (const char* text :
       {"arms=false", "gain=2", "steps=4", "period=40ms", "swing.angle=17deg", "speed=-0.5"}) {
    assignParameter(example, text);
  }
  EXPECT_FALSE(example.arms);
  EXPECT_EQ(example.gain, 2.0);
  EXPECT_EQ(example.steps, 4);
  EXPECT_EQ(example.period, 0.04);
  EXPECT_EQ(example.swing.angle, toRadians(17));
  EXPECT_EQ(example.speed, -0.5);
  assignParameter(example, "arms=1");
  EXPECT_TRUE(example.arms);
  assignParameter(example, "arms=off");
  EXPECT_FALSE(example.arms);
}

// The two ways to set a value from a command line read the same things.
TEST(Parameters, AssignmentsAndTextsAreReadAlike) {
  for (const auto& [key, text] : std::vector<std::pair<const char*, const char*>>{{"gain", "+0.2"},
                                                                                  {"speed", "-0.5"},
                                                                                  {"period", "+40 ms"},
                                                                                  {"swing.angle", "17deg"},
                                                                                  {"steps", "4"},
                                                                                  {"arms", "off"},
                                                                                  {"arms", "0"},
                                                                                  {"arms", "false"}}) {
    Example assigned;
    Example set;
    assignParameter(assigned, std::string(key) + "=" + text);
    setParameterText(set, key, text);
    EXPECT_EQ(toToml(assigned), toToml(set)) << key << " " << text;
    EXPECT_NE(toToml(set), toToml(Example{})) << key << " " << text;
  }
}

TEST(Parameters, WrongAssignmentsSayWhatToWrite) {
  const std::vector<std::pair<const char*, const char*>> cases = {
      {"arms=2", "arms=2: arms is a switch: use true or false"},
      {"arms=no", "use true or false"},
      {"gain", "gain: give it as name=value"},
      {"gain=fast", "use a number"},
      {"steps=1.5", "must be a whole number"},
      {"period=3deg", "use a number in s, or one with a unit: s, ms"},
      {"gain=11", "out of range"},
      {"gian=1", "did you mean 'gain'?"},
  };
  for (const auto& [text, message] : cases) {
    Example example;
    try {
      assignParameter(example, text);
      ADD_FAILURE() << text;
    } catch (const ParameterError& error) {
      EXPECT_THAT(error.what(), HasSubstr(message));
    }
  }
}

TEST(Nearest, DistanceIsThatOfTheTextbook) {
  EXPECT_EQ(editDistance("kitten", "sitting"), 3U);  // Levenshtein's usual example
  EXPECT_EQ(editDistance("", "abc"), 3U);
  EXPECT_EQ(nearestOf({"match", "serve", "play"}, "mach"), "match");
  EXPECT_EQ(nearestOf({}, "x"), "");
}

}  // namespace
}  // namespace nonet::config
