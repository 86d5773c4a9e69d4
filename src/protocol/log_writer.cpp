#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <zstd.h>

#include "nonet/protocol/log_file.h"

#include "log_header.h"

namespace nonet::protocol {

struct LogWriter::Compressor {
  struct StreamFree {
    void operator()(ZSTD_CCtx* stream) const { ZSTD_freeCCtx(stream); }
  };
  std::unique_ptr<ZSTD_CCtx, StreamFree> stream{ZSTD_createCCtx()};
  std::vector<char> output = std::vector<char>(ZSTD_CStreamOutSize());
};

LogWriter::LogWriter(std::string path, const LogHeader& header, int flushInterval)
    : path_(std::move(path)),
      file_(std::fopen(path_.c_str(), "wb")),
      compressor_(std::make_unique<Compressor>()),
      flushInterval_(std::max(1, flushInterval)) {
  if (file_ == nullptr) {
    throw LogError(fmt::format("{}: cannot be created: {}", path_, std::strerror(errno)));
  }
  ZSTD_CCtx_setParameter(compressor_->stream.get(), ZSTD_c_checksumFlag, 1);
  line_.reserve(std::size_t{1} << 14U);
  line_ = headerLine(header);
  compress(line_, ZSTD_e_continue);
  flush();
}

LogWriter::~LogWriter() {
  close();
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
  compress(line_, ZSTD_e_continue);
}

void LogWriter::flush() {
  sinceFlush_ = 0;
  compress({}, ZSTD_e_flush);
  if (file_ != nullptr && std::fflush(file_) != 0) {
    fail(std::strerror(errno));
  }
}

void LogWriter::close() {
  if (file_ == nullptr) {
    return;
  }
  compress({}, ZSTD_e_end);
  if (file_ != nullptr && std::fclose(std::exchange(file_, nullptr)) != 0) {
    fail(std::strerror(errno));
  }
}

void LogWriter::compress(std::string_view text, int directive) {
  ZSTD_inBuffer input{text.data(), text.size(), 0};
  bool done = false;
  while (!done && file_ != nullptr) {
    std::vector<char>& buffer = compressor_->output;
    ZSTD_outBuffer output{buffer.data(), buffer.size(), 0};
    const std::size_t remaining = ZSTD_compressStream2(compressor_->stream.get(), &output, &input,
                                                       static_cast<ZSTD_EndDirective>(directive));
    if (ZSTD_isError(remaining) != 0) {
      fail(ZSTD_getErrorName(remaining));
    } else if (std::fwrite(buffer.data(), 1, output.pos, file_) != output.pos) {
      fail(std::strerror(errno));
    }
    done = directive == ZSTD_e_continue ? input.pos == input.size : remaining == 0;
  }
}

void LogWriter::fail(std::string_view what) {
  error_ = fmt::format("{}: recording stops, it cannot be written: {}", path_, what);
  if (file_ != nullptr) {
    std::fclose(std::exchange(file_, nullptr));
  }
}

}  // namespace nonet::protocol
