// Files of one JSON text a line, to which a process appends that may be killed at any time.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace nonet::lab {

/// All whole lines, in their order; none if there is no such file. Half a line that a killed process left at
/// the end is cut off, so that the next line begins well. Throws std::runtime_error that names file and line:
/// a line is damaged.
std::vector<nlohmann::ordered_json> readWholeLines(const std::string& path);

/// On the disk when it returns. Throws std::runtime_error: the line cannot be written.
void appendLine(const std::string& path, const nlohmann::ordered_json& line);

}  // namespace nonet::lab
