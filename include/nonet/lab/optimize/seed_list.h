// The seeds of a measurement, named by the rule that drew them: a file says "100 of seed 1", not a hundred
// numbers.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace nonet::lab {

/// What the seeds of trials are drawn for.
enum class SeedStream : int { Candidates = 0, Validation = 1 };

/// The trial seeds of a generation of a run. 32 bits each, so that TOML and JSON readers of all languages
/// take them. Of two lists that differ in `count` only, the shorter is the beginning of the longer.
std::vector<std::uint64_t> trialSeeds(std::uint64_t runSeed, int generation, SeedStream stream, int count);

/// The first `count` validation seeds of this run and generation.
struct SeedDraw {
  std::uint64_t seed = 0;
  int generation = 0;
  int count = 0;
};

class SeedList {
 public:
  void add(const SeedDraw& draw) { items_.emplace_back(draw); }
  /// A seed without a rule, as older files list them.
  void add(std::uint64_t seed) { items_.emplace_back(seed); }

  /// All seeds, in order.
  std::vector<std::uint64_t> all() const;
  std::size_t size() const;

  /// Each draw an object {"seed", "generation", "count"}, each seed without a rule a number.
  nlohmann::json toJson() const;
  /// Throws nlohmann::json::exception.
  static SeedList fromJson(const nlohmann::json& value);
  /// The same as a TOML array with inline tables.
  std::string toToml() const;

 private:
  std::vector<std::variant<std::uint64_t, SeedDraw>> items_;
};

}  // namespace nonet::lab
