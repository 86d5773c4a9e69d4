// The recorded messages in tests/data/protocol.
#pragma once

#include <string>
#include <vector>

#include "nonet/protocol/log_file.h"

namespace nonet::protocol {

inline std::vector<std::string> goldenLines(LogLine::Kind kind) {
  LogReader reader(NONET_TEST_DATA "/protocol/golden.log.gz");
  std::vector<std::string> lines;
  for (LogLine line; reader.next(line);) {
    if (line.kind == kind) {
      lines.emplace_back(line.text);
    }
  }
  return lines;
}

}  // namespace nonet::protocol
