// A text file that is compressed with zstd while it is written, for logs of hours.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace nonet::protocol {

/// A full disk must not end a match: after an error nothing more is written, and error() says why.
class CompressedFile {
 public:
  /// Throws LogError if the file cannot be created.
  explicit CompressedFile(std::string path);
  ~CompressedFile();
  CompressedFile(const CompressedFile&) = delete;
  CompressedFile& operator=(const CompressedFile&) = delete;

  void write(std::string_view text);
  /// What has been written is on its way to the disk and can be decoded: a process that is killed later does
  /// not lose it.
  void flush();
  /// Ends the file; nothing is written after that. The destructor does the same.
  void close();

  bool failed() const { return !error_.empty(); }
  const std::string& error() const { return error_; }
  const std::string& path() const { return path_; }

 private:
  struct Compressor;

  void compress(std::string_view text, int directive);
  void fail(std::string_view what);

  std::string path_;
  std::string error_;
  std::FILE* file_ = nullptr;
  std::unique_ptr<Compressor> compressor_;
};

}  // namespace nonet::protocol
