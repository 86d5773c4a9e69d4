// The fuzz targets without a fuzzer: every file of the corpora, and seeded mutations of them, through the
// same properties. What a fuzzer has found stays in the corpus.
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>

#include <gtest/gtest.h>

#include "nonet/math/random.h"

#include "../protocol/round_trip_properties.h"
#include "framing_properties.h"
#include "log_properties.h"
#include "monitor_properties.h"
#include "parameter_properties.h"
#include "say_properties.h"
#include "skill_properties.h"
#include "trainer_properties.h"

namespace nonet::fuzz {
namespace {

namespace fs = std::filesystem;

std::string checkSexpr(std::string_view bytes) {
  for (const std::string& problem :
       {protocol::checkEffectors(bytes), protocol::checkReader<protocol::SexprDialect::Plain>(bytes),
        protocol::checkReader<protocol::SexprDialect::Commands>(bytes)}) {
    if (!problem.empty()) return problem;
  }
  return {};
}

/// The name is that of the target, NAME_fuzz.cpp, and of its folder in the corpus.
struct Target {
  const char* name;
  std::string (*check)(std::string_view);
  int mutations;  // as many as take about a second
};

constexpr Target kTargets[] = {
    {"sexpr", checkSexpr, 20000},
    {"percept", protocol::checkPercept, 20000},
    {"say", checkSay, 100000},
    {"framing", checkFraming, 20000},
    {"log", checkLog, 5000},
    {"skill", checkSkillText, 5000},
    {"parameters", checkParameterText, 300},
    {"monitor", checkMonitorStream, 5000},
    {"trainer", checkTrainer, 500},
};

std::vector<std::string> corpusOf(const std::string& name) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(fs::path(NONET_TEST_DATA) / "../fuzz/corpus" / name))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const fs::path& path : paths) {
    std::ifstream file(path, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return texts;
}

/// Cuts, copies, overwrites, inserts, and takes over parts of another text: one to eight times.
std::string mutated(std::string text, const std::string& other, Random& random) {
  static constexpr std::string_view kSpice = "()[]{} \t\n'\";#=.,-+0123456789eEnaifPLB\\\0\xff\x28";
  const auto placeIn = [&random](const std::string& in) { return in.empty() ? 0 : random.below(in.size()); };
  for (std::uint64_t i = 1 + random.below(8); i > 0; --i) {
    const std::size_t at = placeIn(text);
    const std::size_t length = 1 + random.below(40);
    switch (random.below(6)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, text.substr(placeIn(text), length));
        break;
      case 2:
        if (!text.empty()) text[at] = kSpice[random.below(kSpice.size())];
        break;
      case 3:
        text.insert(at, 1, kSpice[random.below(kSpice.size())]);
        break;
      case 4:
        text.insert(at, other.substr(placeIn(other), length));
        break;
      default:
        if (random.below(8) == 0) text.resize(at);
    }
  }
  return text;
}

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, EveryFileAndItsMutationsKeepTheProperties) {
  const auto texts = corpusOf(GetParam().name);
  ASSERT_GE(texts.size(), 3U);
  for (const std::string& text : texts) ASSERT_EQ(GetParam().check(text), "") << text;
  Random random(7);
  for (int i = 0; i < GetParam().mutations; ++i) {
    const std::string text =
        mutated(texts[random.below(texts.size())], texts[random.below(texts.size())], random);
    ASSERT_EQ(GetParam().check(text), "") << "mutation " << i << ":\n" << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus, testing::ValuesIn(kTargets),
                         [](const testing::TestParamInfo<Target>& info) { return info.param.name; });

TEST(Fuzz, EveryTargetHasACorpusAndIsTriedHere) {
  std::map<std::string, int> seen;
  for (const Target& target : kTargets) ++seen[target.name];
  for (const auto& entry : fs::directory_iterator(fs::path(NONET_TEST_DATA) / "../fuzz/corpus"))
    ++seen[entry.path().filename().string()];
  for (const auto& entry : fs::directory_iterator(fs::path(NONET_TEST_DATA) / "../fuzz")) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with("_fuzz.cpp")) ++seen[name.substr(0, name.size() - 9)];
  }
  for (const auto& [name, count] : seen) EXPECT_EQ(count, 3) << name;
}

}  // namespace
}  // namespace nonet::fuzz
