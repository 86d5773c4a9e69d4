// Messages on a TCP stream: four bytes of length, most significant first, then as many bytes of text (server
// facts 1.1). The stream may be cut anywhere.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nonet::protocol {

inline constexpr std::size_t kFrameHeaderSize = 4;
inline constexpr std::size_t kDefaultMaxFrame = std::size_t{1}
                                                << 20;  // bytes; the longest real message has 6 kB

/// Puts the pieces of a stream together. Memory grows with what has arrived, never with what a length field
/// promises, and is kept; in steady state nothing is allocated.
class FrameReader {
 public:
  explicit FrameReader(std::size_t maxLength = kDefaultMaxFrame) : maxLength_(maxLength) {}

  /// Room to receive `size` bytes into; then call received() with the number that came. After either call the
  /// views that next() has given are no longer valid.
  std::span<char> prepare(std::size_t size);
  void received(std::size_t size);
  /// Does both with bytes that lie elsewhere.
  void append(std::string_view bytes);

  /// The next complete message (it may be empty), nothing if more bytes are needed or the stream has failed.
  /// Call until it gives nothing, then receive again.
  std::optional<std::string_view> next();

  /// True after a length above the limit: where the next message begins is unknown then, so the connection
  /// must be given up. error() says it in a sentence.
  bool failed() const { return !error_.empty(); }
  const std::string& error() const { return error_; }

  /// Starts again with an empty stream.
  void reset();

 private:
  std::size_t maxLength_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  // of what next() has not given yet
  std::size_t end_ = 0;    // of what has arrived
  std::string error_;
};

/// The four bytes before a message of `length` bytes; length < 2^32.
std::array<char, kFrameHeaderSize> frameHeader(std::size_t length);

/// Appends header and message.
void appendFrame(std::string& stream, std::string_view message);

}  // namespace nonet::protocol
