// Files of JSON that a process has written which may be killed at any time: of one text a line, to which it
// appends, and of a single one.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace nonet::lab {

/// All whole lines, in their order; none if there is no such file. Half a line that a killed process left at
/// the end is cut off, so that the next line begins well. Throws std::runtime_error that names file and line:
/// a line is damaged.
std::vector<nlohmann::ordered_json> readWholeLines(const std::string& path);

/// On the disk when it returns. Throws std::runtime_error: the line cannot be written.
void appendLine(const std::string& path, const nlohmann::ordered_json& line);

/// What `read` makes of the file's JSON. Throws std::runtime_error with the file's name and the remedy,
/// beside what `read` throws itself, if that is no JSON, or lacks a key that is asked for.
template <class Read>
auto readOrDamaged(const std::string& path, const std::string& remedy, const Read& read) {
  try {
    return read();
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(fmt::format("{}: is damaged: {} ({})", path, remedy, error.what()));
  }
}

}  // namespace nonet::lab
