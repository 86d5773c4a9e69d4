// Reads the excerpts of recordings in tests/data/world.
#pragma once

#include <functional>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "nonet/math/types.h"
#include "nonet/protocol/log_file.h"
#include "nonet/protocol/percept.h"
#include "nonet/protocol/percept_text.h"

namespace nonet::world::test {

inline std::string dataPath(const std::string& name) {
  return std::string(NONET_TEST_DATA) + "/world/" + name;
}

/// Calls `onMessage` for each message, and `onTruth` for the torso's exact pose (world frame W, robot axes)
/// of the message before, where the recording has it.
inline void readRecording(const std::string& name,
                          const std::function<void(const protocol::Percept&)>& onMessage,
                          const std::function<void(const Pose3&)>& onTruth = {}) {
  protocol::LogReader reader(dataPath(name));
  protocol::LogLine line;
  protocol::Percept percept;
  int messages = 0;
  while (reader.next(line)) {
    if (line.kind == protocol::LogLine::Kind::Received) {
      protocol::parsePercept(line.text, percept);
      ++messages;
      onMessage(percept);
    } else if (line.kind == protocol::LogLine::Kind::Truth && onTruth) {
      std::istringstream text{std::string(line.text)};
      Eigen::Matrix4d m;
      for (int i = 0; i < 16; ++i) text >> m(i % 4, i / 4);
      // The server's torso has x to the right and y forward.
      Pose3 X_WR = Pose3::Identity();
      X_WR.linear().col(0) = m.block<3, 1>(0, 1);
      X_WR.linear().col(1) = -m.block<3, 1>(0, 0);
      X_WR.linear().col(2) = m.block<3, 1>(0, 2);
      X_WR.translation() = m.block<3, 1>(0, 3);
      onTruth(X_WR);
    }
  }
  ASSERT_GT(messages, 50) << name;
}

}  // namespace nonet::world::test
