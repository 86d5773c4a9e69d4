// Bytes of a file, decompressed if need be: plain, gzip or zstd, told apart by the first bytes.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "nonet/protocol/log_file.h"

namespace nonet::protocol {

class ByteSource {
 public:
  enum class State { Whole, Truncated, Corrupt };

  virtual ~ByteSource() = default;
  /// Fills `out` with up to `size` (> 0) bytes and returns how many; 0 at the end. Throws LogError, naming
  /// the file, if the disk cannot be read.
  virtual std::size_t read(char* out, std::size_t size) = 0;
  /// What the end was like, once read() has returned 0.
  State state() const { return state_; }
  /// What the decompressor said if the data are corrupt.
  const std::string& detail() const { return detail_; }

 protected:
  State state_ = State::Whole;
  std::string detail_;
};

/// How the log in a source ends, and what is wrong with that, without the file's name.
struct SourceEnd {
  LogReader::End end = LogReader::End::Whole;
  std::string what;  // empty if it is whole
};

/// Once read() has returned 0. `rest`: something is left behind the last whole line or message.
SourceEnd endOf(const ByteSource& source, bool rest);

/// Throws LogError, naming the file, if it cannot be opened or read.
std::unique_ptr<ByteSource> openByteSource(const std::string& path);

}  // namespace nonet::protocol
