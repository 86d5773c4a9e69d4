#include "nonet/lab/optimize/seed_list.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "nonet/math/random.h"

namespace nonet::lab {

using nlohmann::json;

std::vector<std::uint64_t> trialSeeds(std::uint64_t runSeed, int generation, SeedStream stream, int count) {
  Random random =
      Random(runSeed).fork(2U * static_cast<std::uint64_t>(generation) + static_cast<std::uint64_t>(stream));
  std::vector<std::uint64_t> seeds;
  seeds.reserve(static_cast<std::size_t>(std::max(count, 0)));
  for (int i = 0; i < count; ++i) seeds.push_back(random.next() >> 32U);
  return seeds;
}

std::vector<std::uint64_t> SeedList::all() const {
  std::vector<std::uint64_t> seeds;
  for (const auto& item : items_) {
    if (const auto* draw = std::get_if<SeedDraw>(&item)) {
      const auto drawn = trialSeeds(draw->seed, draw->generation, SeedStream::Validation, draw->count);
      seeds.insert(seeds.end(), drawn.begin(), drawn.end());
    } else {
      seeds.push_back(std::get<std::uint64_t>(item));
    }
  }
  return seeds;
}

std::size_t SeedList::size() const {
  std::size_t count = 0;
  for (const auto& item : items_) {
    const auto* draw = std::get_if<SeedDraw>(&item);
    count += draw != nullptr ? static_cast<std::size_t>(std::max(draw->count, 0)) : 1U;
  }
  return count;
}

json SeedList::toJson() const {
  json list = json::array();
  for (const auto& item : items_) {
    if (const auto* draw = std::get_if<SeedDraw>(&item)) {
      list.push_back({{"seed", draw->seed}, {"generation", draw->generation}, {"count", draw->count}});
    } else {
      list.push_back(std::get<std::uint64_t>(item));
    }
  }
  return list;
}

SeedList SeedList::fromJson(const json& value) {
  SeedList list;
  for (const json& item : value) {
    if (item.is_object()) {
      list.add(SeedDraw{item.at("seed").get<std::uint64_t>(), item.at("generation").get<int>(),
                        item.at("count").get<int>()});
    } else {
      list.add(item.get<std::uint64_t>());
    }
  }
  return list;
}

// Whole numbers of TOML have 64 bits with a sign: the reader casts back.
std::string SeedList::toToml() const {
  const auto number = [](std::uint64_t seed) { return static_cast<std::int64_t>(seed); };
  std::vector<std::string> texts;
  for (const auto& item : items_) {
    if (const auto* draw = std::get_if<SeedDraw>(&item)) {
      texts.push_back(fmt::format("{{ seed = {}, generation = {}, count = {} }}", number(draw->seed),
                                  draw->generation, draw->count));
    } else {
      texts.push_back(fmt::format("{}", number(std::get<std::uint64_t>(item))));
    }
  }
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace nonet::lab
