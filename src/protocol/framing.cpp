#include "nonet/protocol/framing.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

namespace nonet::protocol {

std::span<char> FrameReader::prepare(std::size_t size) {
  if (begin_ == end_) {
    begin_ = end_ = 0;
  }
  if (buffer_.size() - end_ < size && begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (buffer_.size() - end_ < size) {
    buffer_.resize(std::max(end_ + size, 2 * buffer_.size()));
  }
  return {buffer_.data() + end_, size};
}

void FrameReader::received(std::size_t size) {
  assert(size <= buffer_.size() - end_);
  end_ += size;
}

void FrameReader::append(std::string_view bytes) {
  const std::span<char> room = prepare(bytes.size());
  std::copy(bytes.begin(), bytes.end(), room.begin());
  received(bytes.size());
}

std::optional<std::string_view> FrameReader::next() {
  if (failed() || end_ - begin_ < kFrameHeaderSize) {
    return std::nullopt;
  }
  std::uint32_t length = 0;
  for (std::size_t i = 0; i < kFrameHeaderSize; ++i) {
    length = length << 8U | static_cast<unsigned char>(buffer_[begin_ + i]);
  }
  if (length > maxLength_) {
    error_ =
        fmt::format("a message of {} bytes was announced, more than the limit of {}", length, maxLength_);
    return std::nullopt;
  }
  if (end_ - begin_ - kFrameHeaderSize < length) {
    return std::nullopt;
  }
  const std::string_view message(buffer_.data() + begin_ + kFrameHeaderSize, length);
  begin_ += kFrameHeaderSize + length;
  return message;
}

void FrameReader::reset() {
  begin_ = end_ = 0;
  error_.clear();
}

std::array<char, kFrameHeaderSize> frameHeader(std::size_t length) {
  assert(length <= UINT32_MAX);
  std::array<char, kFrameHeaderSize> header{};
  for (std::size_t i = 0; i < kFrameHeaderSize; ++i) {
    header[i] = static_cast<char>(length >> (8U * (kFrameHeaderSize - 1 - i)) & 0xFFU);
  }
  return header;
}

void appendFrame(std::string& stream, std::string_view message) {
  const auto header = frameHeader(message.size());
  stream.append(header.data(), header.size());
  stream.append(message);
}

}  // namespace nonet::protocol
