#include "log_header.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace nonet::protocol {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kMark = "# nonet-log ";
constexpr int kFormat = 1;

/// Only whole numbers that fit: others the library would convert, with a result that the language leaves
/// open.
template <class Integer>
void readInteger(const Json& json, const char* key, Integer& value) {
  const Json& number = json.at(key);
  const bool fits = number.is_number_unsigned()
                        ? std::in_range<Integer>(number.get<std::uint64_t>())
                        : number.is_number_integer() && std::in_range<Integer>(number.get<std::int64_t>());
  if (!fits) throw std::out_of_range(fmt::format("{} is no whole number that fits", key));
  number.get_to(value);
}

}  // namespace

std::string headerLine(const LogHeader& header) {
  Json json;
  json["version"] = header.version;
  json["team"] = header.team;
  json["unum"] = header.unum;
  json["type"] = header.robotType;
  json["seed"] = header.seed;
  json["parameters"] = header.parameters;
  json["options"] = header.options;
  // Bytes that are not UTF-8 (a team name from the command line) must not keep a match from being recorded.
  return fmt::format("{}{} {}\n", kMark, kFormat, json.dump(-1, ' ', true, Json::error_handler_t::replace));
}

std::optional<LogHeader> parseHeaderLine(std::string_view line, const std::string& path) {
  if (line.substr(0, kMark.size()) != kMark) {
    return std::nullopt;
  }
  line.remove_prefix(kMark.size());
  const std::size_t blank = line.find(' ');
  if (line.substr(0, blank) != fmt::format("{}", kFormat)) {
    throw LogError(fmt::format("{}: log format {} is not known; this program reads format {}", path,
                               line.substr(0, blank), kFormat));
  }
  try {
    const Json json = Json::parse(blank == std::string_view::npos ? std::string_view() : line.substr(blank));
    LogHeader header;
    json.at("version").get_to(header.version);
    json.at("team").get_to(header.team);
    readInteger(json, "unum", header.unum);
    readInteger(json, "type", header.robotType);
    readInteger(json, "seed", header.seed);
    json.at("parameters").get_to(header.parameters);
    header.options = json.value("options", std::map<std::string, std::string>());
    return header;
  } catch (const std::exception& error) {
    throw DamagedLog(fmt::format("{}: the header line cannot be read: {}", path, error.what()));
  }
}

}  // namespace nonet::protocol
