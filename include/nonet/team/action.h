// What the robot has decided to do in this cycle, and why.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "nonet/math/inline_string.h"
#include "nonet/math/pose2.h"
#include "nonet/motion/request.h"

namespace nonet::team {

/// One of the things that were weighed against each other.
struct Candidate {
  Vector2 p_F = Vector2::Zero();  // where it leads, own field frame, m
  double value = 0.0;             // the largest one is chosen
};

/// Room for what was weighed in one choice. Choices write to it only when somebody wants to know.
class Candidates {
 public:
  void clear() { count_ = 0; }
  void add(const Vector2& p_F, double value) {
    if (count_ < items_.size()) items_[count_++] = {p_F, value};
  }
  std::span<const Candidate> all() const { return {items_.data(), count_}; }

 private:
  std::array<Candidate, 64> items_{};
  std::size_t count_ = 0;
};

/// Why an action was chosen. Names are constants of the program: a reason costs two pointers.
struct Reason {
  std::string_view behavior;              // of the strategy (strategy.h); empty before the first decision
  std::string_view detail;                // which of its cases
  std::span<const Candidate> candidates;  // empty unless recorded; valid until the next decision
};

/// A pass that this player is about to play, for the receiver to know before the ball is kicked (radio.h).
struct PassAnnouncement {
  int receiver = 0;                     // number of the team mate
  Vector2 p_FTarget = Vector2::Zero();  // where it can meet the ball, own field frame, m
  double kickAt = 0.0;                  // server time at which the foot meets the ball, s
  double thereAt = 0.0;                 // server time at which the ball is there, s
};

struct Action {
  Action() = default;
  Action(const motion::MotionRequest& request, std::string_view detail) : motion(request) {
    reason.detail = detail;
  }

  motion::MotionRequest motion;
  std::optional<motion::HeadRequest> head;  // a behaviour that leaves it empty watches the ball
  std::optional<Pose2> beam;                // own field frame
  std::optional<PassAnnouncement> pass;     // for as long as the pass is going to be played
  std::optional<InlineString<64>> say;      // at most 20 allowed characters
  bool passMode = false;                    // asks the referee for it (pass_mode.h)
  Reason reason;
};

}  // namespace nonet::team
