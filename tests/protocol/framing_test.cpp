#include "nonet/protocol/framing.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/random.h"

namespace nonet::protocol {
namespace {

TEST(Framing, HeaderIsBigEndian) {
  std::string stream;
  appendFrame(stream, std::string(0x0102, 'x'));
  EXPECT_EQ(stream.substr(0, 5), std::string("\x00\x00\x01\x02x", 5));
  EXPECT_EQ(frameHeader(0xFEDCBA98), (std::array<char, 4>{'\xFE', '\xDC', '\xBA', '\x98'}));
}

// Random messages through random fragments, by both ways of receiving, come out as they went in.
TEST(Framing, AnyFragmentation) {
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::string> messages(1 + random.below(30));
    std::string stream;
    for (std::string& message : messages) {
      message.resize(random.below(4) == 0 ? 0 : random.below(random.below(8) == 0 ? 20000 : 50));
      for (char& c : message) {
        c = static_cast<char>(random.next());
      }
      appendFrame(stream, message);
    }
    const std::uint64_t largest = 1 + random.below(random.below(2) == 0 ? 6 : 30000);
    FrameReader reader(20000);
    std::vector<std::string> received;
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t size = std::min<std::size_t>(stream.size() - at, 1 + random.below(largest));
      const std::string_view piece = std::string_view(stream).substr(at, size);
      if (random.below(2) == 0) {
        reader.append(piece);
      } else {
        const auto room = reader.prepare(size + random.below(100));
        std::copy(piece.begin(), piece.end(), room.begin());
        reader.received(size);
      }
      at += size;
      while (const auto message = reader.next()) {
        received.emplace_back(*message);
      }
    }
    ASSERT_FALSE(reader.failed());
    ASSERT_EQ(received, messages);
  }
}

TEST(Framing, LengthIsBounded) {
  FrameReader reader;
  std::string stream;
  appendFrame(stream, "ok");
  appendFrame(stream, std::string(kDefaultMaxFrame, 'x'));
  reader.append(stream);
  EXPECT_EQ(reader.next(), "ok");
  EXPECT_EQ(reader.next()->size(), kDefaultMaxFrame);
  const auto header = frameHeader(kDefaultMaxFrame + 1);
  reader.append({header.data(), header.size()});
  EXPECT_FALSE(reader.failed());
  EXPECT_FALSE(reader.next());
  ASSERT_TRUE(reader.failed());
  EXPECT_NE(reader.error().find("1048577"), std::string::npos) << reader.error();
  EXPECT_NE(reader.error().find("1048576"), std::string::npos) << reader.error();
  reader.append(stream);
  EXPECT_FALSE(reader.next());  // there is no way back into step
  reader.reset();
  EXPECT_FALSE(reader.failed());
  reader.append(stream);
  EXPECT_EQ(reader.next(), "ok");
}

TEST(Framing, EmptyMessagesAreMessages) {
  FrameReader reader(0);
  reader.append(std::string(8, '\0'));
  EXPECT_EQ(reader.next(), "");
  EXPECT_EQ(reader.next(), "");
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.failed());
}

}  // namespace
}  // namespace nonet::protocol
