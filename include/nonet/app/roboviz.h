// Drawings for RoboViz (server facts 5.6): the bytes of its commands, and a painter that shows what an agent
// believes and wants. Coordinates are the world's, metres.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <asio/io_context.hpp>
#include <asio/ip/udp.hpp>

#include "nonet/agent/agent.h"

namespace nonet::app {

using RobovizColor = std::array<std::uint8_t, 3>;  // red, green, blue

/// Each appends one command. Shapes are collected in the set's back buffer until robovizSwap() shows them.
void robovizCircle(std::string& bytes, const Vector2& center, double radius, double thickness,
                   const RobovizColor& color, std::string_view set);
void robovizLine(std::string& bytes, const Vector3& from, const Vector3& to, double thickness,
                 const RobovizColor& color, std::string_view set);
void robovizPoint(std::string& bytes, const Vector3& at, double size, const RobovizColor& color,
                  std::string_view set);
void robovizSphere(std::string& bytes, const Vector3& center, double radius, const RobovizColor& color,
                   std::string_view set);
/// Shows all sets whose name begins with `prefix`, and drops what they showed before.
void robovizSwap(std::string& bytes, std::string_view prefix);

/// The picture of one agent, one command per element. The sets are nonet.left.5.pose, .particles,
/// .ball, .target, .path, .pass and .players.
std::vector<std::string> robovizPicture(const agent::Agent& agent);

/// Commands put together in packets of at most 512 bytes, in their order.
std::vector<std::string> robovizPackets(const std::vector<std::string>& commands);

/// Sends pictures by UDP. Nobody needs to listen.
class RobovizPainter {
 public:
  /// Throws std::runtime_error if the host has no address.
  explicit RobovizPainter(const std::string& host, std::uint16_t port = 32769);

  /// After a step of the agent; draws in every fifth one, ten pictures a second.
  void show(const agent::Agent& agent);

 private:
  asio::io_context io_;
  asio::ip::udp::socket socket_;
  asio::ip::udp::endpoint target_;
  int steps_ = 0;
};

}  // namespace nonet::app
