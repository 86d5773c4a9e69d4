// The first line of a log file and its meaning.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "nonet/protocol/log_file.h"

namespace nonet::protocol {

/// With the line end.
std::string headerLine(const LogHeader& header);

/// Nothing if the line is not a header line of ours. Throws LogError, naming `path`, if it is of another
/// format, DamagedLog if it is a broken one.
std::optional<LogHeader> parseHeaderLine(std::string_view line, const std::string& path);

}  // namespace nonet::protocol
