// The bytes of RoboViz' drawing commands against server facts 5.6, written out by hand.
#include "nonet/app/roboviz.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <asio.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/protocol/percept_text.h"

namespace nonet::app {
namespace {

using std::string_literals::operator""s;

const RobovizColor kColor = {255, 0, 16};

TEST(Roboviz, CommandsByteByByte) {
  std::string bytes;
  robovizCircle(bytes, {1.5, -2.25}, 0.5, 2.0, kColor, "a.b");
  EXPECT_EQ(bytes, "\x01\x00"s + "1.5000" + "-2.250" + "0.5000" + "2.0000" + "\xff\x00\x10"s + "a.b\0"s);
  bytes.clear();
  robovizLine(bytes, {-12.3456, 0.0, 3.0}, {123.456, 1e-7, -0.00001}, 1.0, kColor, "l");
  EXPECT_EQ(bytes, "\x01\x01"s + "-12.34" + "0.0000" + "3.0000" + "123.45" + "0.0000" + "-0.000" + "1.0000" +
                       "\xff\x00\x10"s + "l\0"s);
  bytes.clear();
  robovizPoint(bytes, {1, 2, 3}, 4, kColor, "p");
  EXPECT_EQ(bytes, "\x01\x02"s + "1.0000" + "2.0000" + "3.0000" + "4.0000" + "\xff\x00\x10"s + "p\0"s);
  bytes.clear();
  robovizSphere(bytes, {1, 2, 3}, 0.042, kColor, "s");
  EXPECT_EQ(bytes, "\x01\x03"s + "1.0000" + "2.0000" + "3.0000" + "0.0420" + "\xff\x00\x10"s + "s\0"s);
  bytes.clear();
  robovizSwap(bytes, "nonet.");
  EXPECT_EQ(bytes, "\x00\x00nonet.\0"s);
}

TEST(Roboviz, NumbersAreSixCharactersWhateverTheyAre) {
  for (const double value : {0.0, -0.0, 1e9, -1e9, 12345.6, 1e-12, std::nan(""), double{INFINITY}}) {
    std::string bytes;
    robovizPoint(bytes, {value, value, value}, value, kColor, "");
    EXPECT_EQ(bytes.size(), 2U + 4 * 6 + 3 + 1) << value;
  }
}

TEST(Roboviz, PacketsKeepTheOrderAndTheLimit) {
  std::vector<std::string> commands;
  std::string all;
  for (int i = 0; i < 40; ++i) {
    robovizSphere(commands.emplace_back(), {1.0 * i, 0, 0}, 0.1, kColor, "nonet.left.5.players");
    all += commands.back();
  }
  std::string joined;
  for (const std::string& packet : robovizPackets(commands)) {
    EXPECT_LE(packet.size(), 512U);
    EXPECT_GT(packet.size(), 0U);
    joined += packet;
  }
  EXPECT_EQ(joined, all);
}

TEST(Roboviz, APictureArrivesAndNobodyNeedsToListen) {
  agent::AgentSettings settings;
  settings.skillFolder = std::string(NONET_SOURCE_DIR) + "/skills";
  agent::Agent agent(settings);
  protocol::Percept percept;
  protocol::parsePercept("(time (now 1.00))(GS (unum 7) (team left) (sl 0) (sr 0) (t 0.00) (pm PlayOn))",
                         percept);
  agent.step(percept);

  asio::io_context io;
  asio::ip::udp::socket listener(io, {asio::ip::address_v4::loopback(), 0});
  RobovizPainter(std::string("127.0.0.1"), listener.local_endpoint().port()).show(agent);
  std::array<char, 1024> buffer{};
  const std::size_t size = listener.receive(asio::buffer(buffer));
  const std::string packet(buffer.data(), size);
  EXPECT_THAT(packet, ::testing::HasSubstr("nonet.left.7.pose"));
  // A robot that is lost has more particles than one packet holds; the swap comes last.
  std::string picture = packet;
  while (!picture.ends_with("\x00\x00nonet.left.7.\0"s)) {
    const std::size_t more = listener.receive(asio::buffer(buffer));
    ASSERT_LE(more, 512U);
    picture.append(buffer.data(), more);
  }
  EXPECT_THAT(picture, ::testing::HasSubstr("nonet.left.7.particles"));
  const auto port = listener.local_endpoint().port();
  listener.close();
  RobovizPainter painter("127.0.0.1", port);
  for (int i = 0; i < 20; ++i) painter.show(agent);
}

}  // namespace
}  // namespace nonet::app
