// What must hold for any file that is opened as a log. Returns what is wrong, or nothing.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include "nonet/protocol/log_file.h"

namespace nonet::fuzz {

/// A file without a disk.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes = {}) : descriptor_(::memfd_create("fuzz", 0)) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count <= 0) break;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

struct ReadLog {
  std::vector<std::pair<protocol::LogLine::Kind, std::string>> lines;
  std::optional<protocol::LogHeader> header;
  protocol::LogReader::End end = protocol::LogReader::End::Whole;
  bool refused = false;
  std::string problem;
};

/// At most `most` lines: a few bytes of compressed data can stand for billions.
inline ReadLog readLog(const std::string& path, std::size_t most, std::string& fault) {
  ReadLog log;
  try {
    protocol::LogReader reader(path);
    log.header = reader.header();
    protocol::LogLine line;
    while (log.lines.size() < most && reader.next(line)) {
      log.lines.emplace_back(line.kind, line.text);
      if (line.number != log.lines.size()) fault = "lines are not counted one by one";
    }
    if (log.lines.size() == most) return log;
    log.end = reader.end();
    log.problem = reader.problem();
    if ((log.end == protocol::LogReader::End::Whole) != log.problem.empty())
      fault = "a problem without a text";
    if (reader.next(line)) fault = "a line after the end";
  } catch (const protocol::LogError& error) {
    log.refused = true;
    if (std::string_view(error.what()).substr(0, path.size()) != path)
      fault = "the error does not name the file";
  }
  return log;
}

inline std::string copyOf(const ReadLog& log, const std::string& path) {
  using Kind = protocol::LogLine::Kind;
  protocol::LogWriter writer(path, log.header.value_or(protocol::LogHeader{}), 3);
  bool headerSeen = !log.header.has_value();
  for (const auto& [kind, text] : log.lines) {
    if (kind == Kind::Received) writer.received(text);
    if (kind == Kind::Sent) writer.sent(text);
    if (kind == Kind::Truth) writer.truth(text);
    if (kind == Kind::Comment && std::exchange(headerSeen, true)) writer.comment(text);
  }
  writer.close();
  return writer.error();
}

/// A carriage return within a line is a blank in our logs.
inline std::string asWritten(std::string text) {
  std::replace(text.begin(), text.end(), '\r', ' ');
  return text;
}

/// Reading ends, and says what it met; what was read is written so that it is read again.
inline std::string checkLog(std::string_view bytes) {
  constexpr std::size_t kMostLines = 20000;
  const MemoryFile file(bytes);
  std::string fault;
  const ReadLog first = readLog(file.path(), kMostLines, fault);
  if (!fault.empty() || first.refused) return fault;

  // To write takes a hundred times longer than to read, so one of sixteen inputs must do.
  if (std::hash<std::string_view>()(bytes) % 16 != 0) return {};
  const MemoryFile copy;
  const std::string error = copyOf(first, copy.path());
  if (!error.empty()) return error;
  const ReadLog second = readLog(copy.path(), kMostLines + 1, fault);
  if (!fault.empty()) return fault;
  if (second.refused || second.end != protocol::LogReader::End::Whole)
    return "the copy is not whole: " + second.problem;
  if (second.lines.empty() || !second.header) return "the copy has no header";
  // Without the header's own line, and without what is no line of a log.
  std::size_t next = 1;
  for (std::size_t i = first.header ? 1 : 0; i < first.lines.size(); ++i) {
    if (first.lines[i].first == protocol::LogLine::Kind::Other) continue;
    const bool same = next < second.lines.size() && second.lines[next].first == first.lines[i].first &&
                      second.lines[next].second == asWritten(first.lines[i].second);
    if (!same) return fmt::format("line {} differs", i + 1);
    ++next;
  }
  return next == second.lines.size() ? "" : "the copy has more lines";
}

}  // namespace nonet::fuzz
