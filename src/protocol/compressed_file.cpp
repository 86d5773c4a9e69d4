#include "nonet/protocol/compressed_file.h"

#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <zstd.h>

#include "nonet/protocol/log_file.h"

namespace nonet::protocol {

struct CompressedFile::Compressor {
  struct StreamFree {
    void operator()(ZSTD_CCtx* stream) const { ZSTD_freeCCtx(stream); }
  };
  std::unique_ptr<ZSTD_CCtx, StreamFree> stream{ZSTD_createCCtx()};
  std::vector<char> output = std::vector<char>(ZSTD_CStreamOutSize());
};

CompressedFile::CompressedFile(std::string path)
    : path_(std::move(path)),
      file_(std::fopen(path_.c_str(), "wb")),
      compressor_(std::make_unique<Compressor>()) {
  if (file_ == nullptr) {
    throw LogError(fmt::format("{}: cannot be created: {}", path_, std::strerror(errno)));
  }
  ZSTD_CCtx_setParameter(compressor_->stream.get(), ZSTD_c_checksumFlag, 1);
}

CompressedFile::~CompressedFile() {
  close();
}

void CompressedFile::write(std::string_view text) {
  compress(text, ZSTD_e_continue);
}

void CompressedFile::flush() {
  compress({}, ZSTD_e_flush);
  if (file_ != nullptr && std::fflush(file_) != 0) {
    fail(std::strerror(errno));
  }
}

void CompressedFile::close() {
  if (file_ == nullptr) {
    return;
  }
  compress({}, ZSTD_e_end);
  if (file_ != nullptr && std::fclose(std::exchange(file_, nullptr)) != 0) {
    fail(std::strerror(errno));
  }
}

void CompressedFile::compress(std::string_view text, int directive) {
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

void CompressedFile::fail(std::string_view what) {
  error_ = fmt::format("{}: recording stops, it cannot be written: {}", path_, what);
  if (file_ != nullptr) {
    std::fclose(std::exchange(file_, nullptr));
  }
}

}  // namespace nonet::protocol
