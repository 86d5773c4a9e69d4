// A decision trace on the disk: one cycle a line as JSON, compressed with zstd.
#pragma once

#include <string>

#include "nonet/agent/agent.h"
#include "nonet/protocol/compressed_file.h"

namespace nonet::app {

class TraceFile {
 public:
  /// Throws protocol::LogError if the file cannot be created.
  explicit TraceFile(std::string path) : file_(std::move(path)) {}

  /// After a step of the agent.
  void add(const agent::Agent& agent);
  /// Ends the file; nothing is written after that. The destructor does the same, but cannot tell of an error.
  void close() { file_.close(); }

  /// A full disk must not end a match: after an error nothing more is written. Empty, or why, with the file's
  /// name.
  const std::string& error() const { return file_.error(); }

 private:
  protocol::CompressedFile file_;
  int sinceFlush_ = 0;
};

}  // namespace nonet::app
