// Log files: the traffic of one agent, a message per line, without the length bytes.
//
//     # nonet-log 1 {"version": ..., "team": ..., "unum": ..., "type": ..., "seed": ..., ...}
//     < (time (now 7.30))(GS ...)...       from the server
//     > (he1 0.5)(syn)                     to the server
//     = {"t": 7.3, "ball": [...], ...}     truth of the message before (experiments only)
//     # anything                           comment
//
// We write them compressed with zstd. Plain text and gzip are read as well; the kind is seen from the first
// bytes, not from the name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "nonet/protocol/compressed_file.h"

namespace nonet::protocol {

/// A file that cannot be opened, read or understood; what() names it.
class LogError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One of our logs whose header line is damaged.
class DamagedLog : public LogError {
 public:
  using LogError::LogError;
};

/// All that is needed to build the same agent again.
struct LogHeader {
  std::string version;  // of the program
  std::string team;
  int unum = 0;
  int robotType = 0;
  std::uint64_t seed = 0;
  std::string parameters;                      // TOML text: the values that the agent was started with
  std::map<std::string, std::string> options;  // whatever else the agent was built from, by name

  friend bool operator==(const LogHeader&, const LogHeader&) = default;
};

/// Writes a compressed log. What has been written is on its way to the disk, decodable, after every
/// `flushInterval` received messages (50 cycles are a second of play), so a process that is killed loses no
/// more. Allocates nothing after construction but for the first long lines.
class LogWriter {
 public:
  /// Throws LogError if the file cannot be created. The header is flushed at once.
  LogWriter(std::string path, const LogHeader& header, int flushInterval = 50);

  void received(std::string_view message);
  void sent(std::string_view message);
  void truth(std::string_view json);
  void comment(std::string_view text);
  void flush();
  /// Ends the file; nothing is written after that. The destructor does the same.
  void close() { file_.close(); }

  /// A full disk must not end a match: after an error nothing more is written, and error() says why.
  bool failed() const { return file_.failed(); }
  const std::string& error() const { return file_.error(); }
  const std::string& path() const { return file_.path(); }

 private:
  void writeLine(char mark, std::string_view text);

  CompressedFile file_;
  std::string line_;
  int flushInterval_;
  int sinceFlush_ = 0;
};

struct LogLine {
  enum class Kind : std::uint8_t { Received, Sent, Truth, Comment, Other };
  Kind kind = Kind::Other;
  std::string_view text;   // without mark and blank (Other: the whole line); valid until the next call
  std::size_t number = 0;  // from 1
};

class ByteSource;

/// Reads a log line by line.
class LogReader {
 public:
  /// Throws LogError if the file cannot be opened or is of a format that this program does not know,
  /// DamagedLog if it is one of ours with a header that cannot be read.
  explicit LogReader(const std::string& path);
  ~LogReader();
  LogReader(LogReader&&) noexcept;
  LogReader& operator=(LogReader&&) noexcept;

  /// The header if the file is one of ours.
  const std::optional<LogHeader>& header() const { return header_; }

  /// The next line, the header line included; false at the end. Throws LogError if the disk cannot be read.
  bool next(LogLine& line);

  /// Whether the file ends as it should, known after next() has returned false. Torn: it stops within a line
  /// or within compressed data, as the log of a killed process does; all whole lines have been given.
  /// Damaged: the compressed data make no sense from some place on; the lines before have been given.
  enum class End : std::uint8_t { Whole, Torn, Damaged };
  End end() const { return end_; }
  /// One sentence with the file's name if the end is not Whole, otherwise empty.
  const std::string& problem() const { return problem_; }
  /// What there is of the line within which the file is torn; empty if compressed data end before it begins.
  std::string_view tornLine() const;

 private:
  bool readLine(std::string_view& line);
  bool fill();
  void stop(End end, std::string_view what);

  std::string path_;
  std::unique_ptr<ByteSource> source_;
  std::string buffer_;
  std::size_t begin_ = 0;    // of the next line in buffer_
  std::size_t scanned_ = 0;  // up to here buffer_ holds no further line end
  std::size_t lineNumber_ = 0;
  std::optional<LogHeader> header_;
  End end_ = End::Whole;
  std::string problem_;
};

}  // namespace nonet::protocol
