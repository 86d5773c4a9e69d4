// One agent's conversation with a server, without sockets: handshake, answers and the count of losses. The
// `play` command feeds it from TCP, `replay` from a log; both get the same bytes for the same messages.
//
// Handshake (server facts 1.3, 1.9): `(scene ..)(syn)` at once, because a lock-step server waits for nobody's
// (syn) only in the first five cycles of a connection; `(init ..)(syn)` in answer to the first message; from
// then on the agent answers. Every batch of messages is answered with exactly one (syn).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "nonet/agent/agent.h"
#include "nonet/protocol/effectors.h"
#include "nonet/protocol/percept.h"
#include "nonet/protocol/server_clock.h"
#include "nonet/protocol/standing_time.h"

namespace nonet::agent {

struct SessionSettings {
  AgentSettings agent;
  bool sync = true;  // end every answer with (syn); a server that runs in real time ignores it
};

struct SessionCounts {
  long messages = 0;    // sense messages received
  long answers = 0;     // answers given
  long passedOver = 0;  // messages that were absorbed but not answered, because a newer one was there already
  long lostCycles = 0;  // cycles whose message never came (gaps in the server's time)
  long unknownTokens = 0;  // predicates or values that the parser skipped
};

class Session {
 public:
  enum class Stage {
    Connecting,   // nothing received yet
    Introducing,  // init is sent or about to be, the server has not named team and number yet
    Playing,      // the server has accepted us
    Refused,      // it has not, after kRefusalPatience messages
  };

  explicit Session(const SessionSettings& settings);
  ~Session();

  /// The first text of a connection. May be called again if the connection is made anew before any message
  /// came.
  std::string_view begin();
  /// Absorbs one sense message: parses it and steps the agent.
  void receive(std::string_view message);
  /// The one answer to all messages since the last one; empty if there were none. What the agent wanted in
  /// messages that were passed over and that must not get lost (beam, pass, say within its turn) goes along.
  std::string_view answer();

  Stage stage() const { return stage_; }
  const SessionCounts& counts() const { return counts_; }
  /// The last message received.
  const protocol::Percept& percept() const { return percept_; }
  const Agent& agent() const { return *agent_; }
  /// The server has run for six days and its time has stopped; the session counts on by messages.
  bool timeStands() const { return standing_.stands(); }

  /// Messages without team and number after our first answer, which holds init, that mean a refusal: the
  /// server's answer takes two (facts 1.3), one second of them leaves room for late ones.
  static constexpr int kRefusalPatience = 50;

 private:
  void watchAcceptance();
  void keepOnce(const protocol::Effectors& older);
  std::string_view write();

  SessionSettings settings_;
  std::unique_ptr<Agent> agent_;
  long introducedAt_ = 0;  // messages received when the first answer was given
  protocol::Percept percept_;
  protocol::Effectors outgoing_;
  SessionCounts counts_;
  std::string text_;
  Stage stage_ = Stage::Connecting;
  int pending_ = 0;  // messages since the last answer
  protocol::ServerClock clock_;
  protocol::StandingTime standing_;
  int saySlot_ = 0;  // the turn in which the last say was made
};

}  // namespace nonet::agent
