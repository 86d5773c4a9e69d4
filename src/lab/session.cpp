#include "nonet/lab/session.h"

#include <cmath>

#include "nonet/protocol/percept_text.h"

namespace nonet::lab {

Session::Session(const SessionOptions& options)
    : options_(options), agent_(std::make_unique<agent::Agent>(options.agent)) {}

Session::~Session() = default;

std::string_view Session::begin() {
  outgoing_.clear();
  outgoing_.scene.emplace().robotType = options_.agent.robotType;
  return write();
}

void Session::receive(std::string_view message) {
  protocol::parsePercept(message, percept_);
  countGap();
  ++counts_.messages;
  counts_.unknownTokens += percept_.unknownTokens;
  if (pending_ > 0) ++counts_.passedOver;
  ++pending_;
  if (stage_ == Stage::Connecting) stage_ = Stage::Introducing;
  watchAcceptance();

  stepped_ = introduced_;
  if (!introduced_) return;
  // A newer answer replaces an older one that was never sent, but for what is said only once.
  const protocol::Effectors older = outgoing_;
  outgoing_ = agent_->step(percept_);
  if (pending_ < 2) return;
  if (!outgoing_.beam) outgoing_.beam = older.beam;
  if (!outgoing_.say) outgoing_.say = older.say;
  outgoing_.pass = outgoing_.pass || older.pass;
}

std::string_view Session::answer() {
  if (pending_ == 0) return {};
  pending_ = 0;
  ++counts_.answers;
  if (!introduced_) {
    introduced_ = true;
    outgoing_.clear();
    protocol::Effectors::Init& init = outgoing_.init.emplace();
    init.unum = options_.agent.unum;
    init.team.assign(options_.agent.team);
  }
  return write();
}

void Session::countGap() {
  // Times are printed with two decimals, so single steps look like 0.01 to 0.03 s.
  if (counts_.messages > 0) {
    const long cycles = std::lround((percept_.time - lastTime_) / kCycleTime);
    if (cycles > 1) counts_.lostCycles += cycles - 1;
  }
  lastTime_ = percept_.time;
}

void Session::watchAcceptance() {
  if (percept_.game.unum || percept_.game.side) stage_ = Stage::Playing;
  if (stage_ == Stage::Introducing && introduced_ && ++messagesSinceInit_ > kRefusalPatience) {
    stage_ = Stage::Refused;
  }
}

std::string_view Session::write() {
  outgoing_.syn = options_.sync;
  text_.clear();
  protocol::writeEffectors(outgoing_, text_);
  return text_;
}

}  // namespace nonet::lab
