#include <fmt/format.h>

#include "nonet/protocol/log_file.h"

#include "byte_source.h"
#include "log_header.h"

namespace nonet::protocol {
namespace {

constexpr std::size_t kReadSize = std::size_t{1} << 17U;
constexpr std::size_t kMaxLine = std::size_t{1} << 25U;  // far above any message: the file is not a log

LogLine::Kind kindOf(std::string_view line) {
  if (line.size() < 2 || line[1] != ' ') {
    return LogLine::Kind::Other;
  }
  switch (line[0]) {
    case '<':
      return LogLine::Kind::Received;
    case '>':
      return LogLine::Kind::Sent;
    case '=':
      return LogLine::Kind::Truth;
    case '#':
      return LogLine::Kind::Comment;
    default:
      return LogLine::Kind::Other;
  }
}

}  // namespace

LogReader::LogReader(const std::string& path) : path_(path), source_(openByteSource(path)) {
  std::string_view line;
  if (readLine(line)) {
    header_ = parseHeaderLine(line, path_);
    begin_ = scanned_ = 0;  // the line will be given again
  }
}

LogReader::~LogReader() = default;
LogReader::LogReader(LogReader&&) noexcept = default;
LogReader& LogReader::operator=(LogReader&&) noexcept = default;

bool LogReader::next(LogLine& line) {
  std::string_view text;
  if (!readLine(text)) {
    return false;
  }
  if (!text.empty() && text.back() == '\r') {
    text.remove_suffix(1);
  }
  line.kind = kindOf(text);
  line.text = line.kind == LogLine::Kind::Other ? text : text.substr(2);
  line.number = ++lineNumber_;
  return true;
}

std::string_view LogReader::tornLine() const {
  return end_ == End::Torn ? std::string_view(buffer_).substr(begin_) : std::string_view();
}

bool LogReader::readLine(std::string_view& line) {
  if (end_ != End::Whole) {
    return false;
  }
  for (;;) {
    const std::size_t lineEnd = buffer_.find('\n', scanned_);
    if (lineEnd != std::string::npos) {
      line = std::string_view(buffer_).substr(begin_, lineEnd - begin_);
      begin_ = scanned_ = lineEnd + 1;
      return true;
    }
    scanned_ = buffer_.size();
    if (scanned_ - begin_ > kMaxLine) {
      stop(End::Damaged, "is not a log, it has no lines");
      return false;
    }
    if (!fill()) {
      return false;
    }
  }
}

bool LogReader::fill() {
  if (begin_ > 0) {
    buffer_.erase(0, begin_);
    scanned_ -= begin_;
    begin_ = 0;
  }
  const std::size_t old = buffer_.size();
  buffer_.resize(old + kReadSize);
  const std::size_t count = source_->read(buffer_.data() + old, kReadSize);
  buffer_.resize(old + count);
  if (count > 0) {
    return true;
  }
  const SourceEnd end = endOf(*source_, !buffer_.empty());
  if (end.end != End::Whole) stop(end.end, end.what);
  return false;
}

void LogReader::stop(End end, std::string_view what) {
  end_ = end;
  problem_ = fmt::format("{}: {}; {} whole lines were read", path_, what, lineNumber_);
}

}  // namespace nonet::protocol
