#include "byte_source.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include "nonet/protocol/log_file.h"

namespace nonet::protocol {
namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

// The raw bytes of the file, with a look at the first ones.
class RawFile {
 public:
  explicit RawFile(std::string path) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "rb")) {
    if (!file_) {
      throw LogError(fmt::format("{}: cannot be opened: {}", path_, std::strerror(errno)));
    }
    refill();
  }

  std::string_view rest() const { return {buffer_.data() + begin_, end_ - begin_}; }
  void consume(std::size_t size) { begin_ += size; }

  /// Reads on if all has been consumed; false at the end of the file.
  bool refill() {
    if (begin_ < end_) {
      return true;
    }
    begin_ = 0;
    end_ = std::fread(buffer_.data(), 1, buffer_.size(), file_.get());
    if (end_ == 0 && std::ferror(file_.get()) != 0) {
      throw LogError(fmt::format("{}: cannot be read: {}", path_, std::strerror(errno)));
    }
    return end_ > 0;
  }

 private:
  std::string path_;
  std::unique_ptr<std::FILE, FileCloser> file_;
  std::vector<char> buffer_ = std::vector<char>(std::size_t{1} << 17U);
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

class PlainSource : public ByteSource {
 public:
  explicit PlainSource(RawFile file) : file_(std::move(file)) {}

  std::size_t read(char* out, std::size_t size) override {
    if (!file_.refill()) {
      return 0;
    }
    const std::size_t count = std::min(size, file_.rest().size());
    std::memcpy(out, file_.rest().data(), count);
    file_.consume(count);
    return count;
  }

 private:
  RawFile file_;
};

// In pieces: of a call that ends with an error nothing comes out, though the data were sound up to there.
class ZstdSource : public ByteSource {
 public:
  explicit ZstdSource(RawFile file) : file_(std::move(file)), stream_(ZSTD_createDStream()) {}

  std::size_t read(char* out, std::size_t size) override {
    ZSTD_outBuffer output{out, std::min(size, kPiece), 0};
    while (state_ != State::Corrupt && output.pos == 0) {
      // Even at the end of the file the decompressor may hold output back, so it is asked once more.
      const bool more = file_.refill();
      ZSTD_inBuffer input{file_.rest().data(), file_.rest().size(), 0};
      const std::size_t hint = ZSTD_decompressStream(stream_.get(), &output, &input);
      file_.consume(input.pos);
      if (ZSTD_isError(hint) != 0) {
        state_ = State::Corrupt;
        detail_ = ZSTD_getErrorName(hint);
      } else if (more || output.pos > 0) {
        insideFrame_ = hint != 0;
      } else {
        state_ = insideFrame_ ? State::Truncated : State::Whole;
        break;
      }
    }
    return output.pos;
  }

 private:
  static constexpr std::size_t kPiece = 4096;
  struct StreamFree {
    void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
  };
  RawFile file_;
  std::unique_ptr<ZSTD_DStream, StreamFree> stream_;
  bool insideFrame_ = false;
};

class GzipSource : public ByteSource {
 public:
  explicit GzipSource(RawFile file) : file_(std::move(file)) {
    constexpr int kGzipWindow = 15 + 16;  // the largest window, gzip header
    inflateInit2(&stream_, kGzipWindow);
  }
  ~GzipSource() override { inflateEnd(&stream_); }

  std::size_t read(char* out, std::size_t size) override {
    stream_.next_out = reinterpret_cast<Bytef*>(out);
    stream_.avail_out = static_cast<uInt>(size);
    const auto room = stream_.avail_out;
    while (state_ != State::Corrupt && stream_.avail_out == room) {
      if (!file_.refill()) {
        state_ = insideMember_ ? State::Truncated : State::Whole;
        break;
      }
      const std::string_view rest = file_.rest();
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest.data()));
      stream_.avail_in = static_cast<uInt>(rest.size());
      const int result = inflate(&stream_, Z_NO_FLUSH);
      file_.consume(rest.size() - stream_.avail_in);
      insideMember_ = result != Z_STREAM_END;
      if (result == Z_STREAM_END) {
        inflateReset(&stream_);  // another member may follow
      } else if (result != Z_OK && result != Z_BUF_ERROR) {
        state_ = State::Corrupt;
        detail_ = stream_.msg != nullptr ? stream_.msg : "not gzip data";
      }
    }
    return room - stream_.avail_out;
  }

 private:
  RawFile file_;
  z_stream stream_{};
  bool insideMember_ = false;
};

}  // namespace

SourceEnd endOf(const ByteSource& source, bool rest) {
  using End = LogReader::End;
  if (source.state() == ByteSource::State::Corrupt)
    return {End::Damaged, fmt::format("the compressed data are damaged ({})", source.detail())};
  if (source.state() == ByteSource::State::Truncated)
    return {End::Torn, "the file was not closed (killed while writing?)"};
  if (rest) return {End::Torn, "the last line is torn"};
  return {};
}

std::unique_ptr<ByteSource> openByteSource(const std::string& path) {
  constexpr std::string_view kZstdMagic("\x28\xB5\x2F\xFD", 4);
  constexpr std::string_view kGzipMagic("\x1F\x8B", 2);
  RawFile file(path);
  if (file.rest().substr(0, kZstdMagic.size()) == kZstdMagic) {
    return std::make_unique<ZstdSource>(std::move(file));
  }
  if (file.rest().substr(0, kGzipMagic.size()) == kGzipMagic) {
    return std::make_unique<GzipSource>(std::move(file));
  }
  return std::make_unique<PlainSource>(std::move(file));
}

}  // namespace nonet::protocol
