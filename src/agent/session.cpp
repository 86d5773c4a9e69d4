#include "nonet/agent/session.h"

#include <algorithm>

#include "nonet/protocol/percept_text.h"
#include "nonet/protocol/say_codec.h"

namespace nonet::agent {

Session::Session(const SessionSettings& settings)
    : settings_(settings), agent_(std::make_unique<Agent>(settings.agent)) {}

Session::~Session() = default;

std::string_view Session::begin() {
  outgoing_ = agent_->hello();
  return write();
}

void Session::receive(std::string_view message) {
  protocol::parsePercept(message, percept_);
  if (protocol::serverStep(percept_.time) == 0.0)
    percept_.time = standing_.next(percept_.time, percept_.game.time);
  counts_.lostCycles += std::max(clock_.cyclesUntil(percept_.time) - 1, 0);
  ++counts_.messages;
  counts_.unknownTokens += percept_.unknownTokens;
  watchAcceptance();
  const protocol::Effectors older = outgoing_;
  outgoing_ = agent_->step(percept_);
  if (outgoing_.say) saySlot_ = protocol::saySlot(percept_.time);
  if (pending_ > 0) {
    ++counts_.passedOver;
    keepOnce(older);
  }
  ++pending_;
}

std::string_view Session::answer() {
  if (pending_ == 0) return {};
  pending_ = 0;
  if (counts_.answers == 0) introducedAt_ = counts_.messages;
  ++counts_.answers;
  return write();
}

void Session::keepOnce(const protocol::Effectors& older) {
  if (!outgoing_.init) outgoing_.init = older.init;
  if (!outgoing_.beam) outgoing_.beam = older.beam;
  // Once it is somebody else's turn, its message would drown theirs.
  if (!outgoing_.say && protocol::saySlot(percept_.time) == saySlot_) outgoing_.say = older.say;
  outgoing_.pass = outgoing_.pass || older.pass;
}

void Session::watchAcceptance() {
  if (stage_ == Stage::Connecting) stage_ = Stage::Introducing;
  if (percept_.game.unum || percept_.game.side) stage_ = Stage::Playing;
  const bool introduced = counts_.answers > 0;
  if (stage_ == Stage::Introducing && introduced && counts_.messages - introducedAt_ > kRefusalPatience)
    stage_ = Stage::Refused;
}

std::string_view Session::write() {
  outgoing_.syn = settings_.sync;
  text_.clear();
  protocol::writeEffectors(outgoing_, text_);
  return text_;
}

}  // namespace nonet::agent
