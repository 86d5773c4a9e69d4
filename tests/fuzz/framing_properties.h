// What must hold for any stream of bytes that is cut anywhere. Returns what is wrong, or nothing.
#pragma once

#include <string>
#include <vector>

#include "nonet/protocol/framing.h"

#include "byte_choices.h"

namespace nonet::fuzz {

struct Unframed {
  std::vector<std::string> messages;
  bool failed = false;
};

inline void drain(protocol::FrameReader& reader, Unframed& result) {
  while (const auto message = reader.next()) result.messages.emplace_back(*message);
  result.failed = reader.failed();
}

inline Unframed inOnePiece(std::string_view stream, std::size_t limit) {
  protocol::FrameReader reader(limit);
  Unframed result;
  reader.append(stream);
  drain(reader, result);
  return result;
}

/// `cuts`: the lengths of the pieces, over and over; by turns received into the reader and copied into it.
inline Unframed inPieces(std::string_view stream, std::size_t limit, std::string_view cuts) {
  protocol::FrameReader reader(limit);
  Unframed result;
  for (std::size_t i = 0; !stream.empty(); ++i) {
    const std::size_t wish = cuts.empty() ? 1 : 1 + static_cast<unsigned char>(cuts[i % cuts.size()]);
    const std::string_view piece = stream.substr(0, wish);
    if (i % 2 == 0) {
      reader.append(piece);
    } else {
      piece.copy(reader.prepare(piece.size() + 3).data(), piece.size());
      reader.received(piece.size());
    }
    stream.remove_prefix(piece.size());
    drain(reader, result);
  }
  return result;
}

/// The same messages and the same failure, however the bytes arrive; and what is framed comes out again.
inline std::string checkFraming(std::string_view bytes) {
  ByteChoices choices(bytes);
  const std::size_t limit = 1 + choices.byte();
  const std::string_view cuts = choices.take(static_cast<std::size_t>(choices.below(8)));
  const std::string_view stream = choices.rest();
  const Unframed whole = inOnePiece(stream, limit);
  const Unframed pieces = inPieces(stream, limit, cuts);
  if (whole.messages != pieces.messages || whole.failed != pieces.failed) return "pieces differ";

  std::string framed;
  for (const std::string& message : whole.messages) protocol::appendFrame(framed, message);
  if (framed != stream.substr(0, framed.size())) return "frames differ";
  // As many messages as fit the limit; a longer one is the end.
  std::vector<std::string> messages;
  std::string again;
  for (std::size_t i = 0; i < stream.size();) {
    const std::size_t length = 1 + static_cast<unsigned char>(stream[i]) % limit;
    messages.emplace_back(stream.substr(i, length));
    protocol::appendFrame(again, messages.back());
    i += length;
  }
  const Unframed back = inPieces(again, limit, cuts);
  return back.messages == messages && !back.failed ? "" : "messages were lost";
}

}  // namespace nonet::fuzz
