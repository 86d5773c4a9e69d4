#include <algorithm>
#include <utility>

#include "nonet/protocol/log_file.h"

#include "log_header.h"

namespace nonet::protocol {

LogWriter::LogWriter(std::string path, const LogHeader& header, int flushInterval)
    : file_(std::move(path)), flushInterval_(std::max(1, flushInterval)) {
  line_.reserve(std::size_t{1} << 14U);
  line_ = headerLine(header);
  file_.write(line_);
  flush();
}

void LogWriter::received(std::string_view message) {
  writeLine('<', message);
  if (++sinceFlush_ >= flushInterval_) {
    flush();
  }
}

void LogWriter::sent(std::string_view message) {
  writeLine('>', message);
}

void LogWriter::truth(std::string_view json) {
  writeLine('=', json);
}

void LogWriter::comment(std::string_view text) {
  writeLine('#', text);
}

void LogWriter::writeLine(char mark, std::string_view text) {
  line_.assign(1, mark);
  line_ += ' ';
  line_ += text;
  // A line end within a message is a blank to its reader; here it would end the record.
  std::replace_if(
      line_.begin(), line_.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  line_ += '\n';
  file_.write(line_);
}

void LogWriter::flush() {
  sinceFlush_ = 0;
  file_.flush();
}

}  // namespace nonet::protocol
