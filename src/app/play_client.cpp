#include "nonet/app/play_client.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <asio.hpp>
#include <fmt/format.h>
#include <netinet/tcp.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/alarm.h"
#include "nonet/app/roboviz.h"
#include "nonet/app/trace_file.h"
#include "nonet/app/turn.h"
#include "nonet/protocol/framing.h"
#include "nonet/protocol/log_file.h"

namespace nonet::app {
namespace {

using asio::ip::tcp;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

// Before our first sense message a lock-step server may need more than the greeting (server facts 1.9): it
// waits a second for any input in each of the cycles until the robot exists; and if the greeting came after
// the fifth cycle of the connection, it waits for a (syn) although there is no message yet that we could
// answer. So (syn) is repeated until the first message comes. If the greeting came so late that the robot
// cannot be built, only a new connection helps. After the first message neither can happen: each message is
// answered, and the server never waits for an answer before the message is out.
constexpr double kSilenceBeforeSyn = 0.15;       // s
constexpr double kSynInterval = 0.25;            // s
constexpr double kSilenceBeforeReconnect = 4.0;  // s, doubled each time
// Agents of one machine take turns to introduce themselves. A turn lasts some 0.1 s; one that a stopped
// process does not give back is ignored after a while, by one agent after the other.
constexpr double kTurnInterval = 0.02;        // s between two looks
constexpr double kTurnPatience = 6.0;         // s
constexpr double kTurnPatiencePerUnum = 0.4;  // s
constexpr double kTurnAfterInit = 0.5;  // s; a server that collects whole teams first accepts nobody before
constexpr double kFirstPause = 0.1;     // s between two attempts to connect, grows by half each time
constexpr double kLongestPause = 2.0;   // s
constexpr double kPauseAfterRefusal =
    2.0;  // s; the server may still hold the robot of a connection that was cut
constexpr std::size_t kReadSize = 65536;  // bytes

/// An agent sends only in answer, so a server that vanished without a word would never be missed. Its kernel
/// is asked now and then; a server that only pauses has one that answers.
void noticeSilentEnd(int socket) {
  const auto set = [socket](int level, int option, int value) {
    ::setsockopt(socket, level, option, &value, sizeof value);
  };
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, 5);          // s without a message until the first question
  set(IPPROTO_TCP, TCP_KEEPINTVL, 2);         // s between two
  set(IPPROTO_TCP, TCP_KEEPCNT, 3);           // without an answer, then the connection is gone
  set(IPPROTO_TCP, TCP_USER_TIMEOUT, 11000);  // ms; the same if the last answer was not acknowledged
}

constexpr const char* kTimeStands =
    "the server's time has stopped, since it has run for six days: it goes on by messages; start the server "
    "anew when you can";

class PlayClient {
 public:
  explicit PlayClient(const PlaySettings& settings) : settings_(settings), signals_(io_, SIGINT, SIGTERM) {
    if (!settings.draw.empty()) painter_ = std::make_unique<RobovizPainter>(settings.draw);
    if (!settings.trace.empty()) trace_ = std::make_unique<TraceFile>(settings.trace);
    if (!settings.record.empty()) openLog(settings.record);
    if (!settings.report.empty()) {
      report_.open(settings.report);
      if (!report_) throw std::runtime_error(cannotWriteReport());
    }
  }

  PlayExit run() {
    signals_.async_wait([this](std::error_code error, int signal) {
      if (!error) finish(PlayExit::Stopped, fmt::format("stopped by signal {}", signal));
    });
    asio::post(io_, [this] { begin(); });
    io_.run();
    endRecordings();
    if (link_) add(link_->session.counts());
    report();
    // Last, since who watches many agents quotes the last line of each.
    if (exit_ == PlayExit::Stopped)
      say("{}", ending_);
    else
      complain(ending_);
    return exit_;
  }

 private:
  /// One connection with all that belongs to it. Its handlers hold it, and do nothing once there is a newer
  /// one.
  struct Connection {
    Connection(asio::io_context& io, const agent::SessionSettings& settings)
        : socket(io), silence(io), session(settings) {}

    tcp::socket socket;
    Alarm silence;
    agent::Session session;  // with its agent: on a new connection the robot has to introduce itself again
    protocol::FrameReader frames;
    std::string outbox;  // frames not yet taken by the socket
    Clock::time_point greeted;
    bool accepted = false;
  };
  using Link = std::shared_ptr<Connection>;

  bool isOver(const Link& link) const { return finished_ || link != link_; }

  double waited() const { return Seconds(Clock::now() - started_).count(); }

  // -- connecting

  /// Towards a message from the server, for which it waits no longer than `wait`. Waiting for one's first
  /// turn does not count.
  void begin() {
    searches_ = false;
    started_ = Clock::now();
    queue();
  }

  /// The queue is that of the server's address, whatever it was called by. A name without one has none.
  void queue() {
    if (!searches_) deadline_.set(settings_.wait, [this] { giveUp(); });
    resolver_.async_resolve(settings_.host, std::to_string(settings_.port),
                            [this](std::error_code error, const tcp::resolver::results_type& endpoints) {
                              if (finished_) return;
                              if (!searches_) deadline_.cancel();
                              if (!error && !endpoints.empty()) turn_.queueFor(endpoints.begin()->endpoint());
                              queuedSince_ = Clock::now();
                              awaitTurn();
                            });
  }

  void awaitTurn() {
    const double patience = kTurnPatience + kTurnPatiencePerUnum * settings_.session.agent.unum;
    const double queued = Seconds(Clock::now() - queuedSince_).count();
    if (!settings_.atOnce && !turn_.take() && queued <= patience)
      return pause_.set(kTurnInterval, [this] { awaitTurn(); });
    if (!searches_) {
      searches_ = true;
      started_ = Clock::now();
      deadline_.set(settings_.wait, [this] { giveUp(); });
    }
    connect();
  }

  void connect() {
    drop();
    link_ = std::make_shared<Connection>(io_, settings_.session);
    resolver_.async_resolve(
        settings_.host, std::to_string(settings_.port),
        [this, link = link_](std::error_code error, const tcp::resolver::results_type& endpoints) {
          if (isOver(link)) return;
          if (error) return retry(error.message());
          asio::async_connect(link->socket, endpoints, [this, link](std::error_code failure, const auto&) {
            if (isOver(link)) return;
            if (failure) return retry(failure.message());
            greet(link);
          });
        });
  }

  void retry(const std::string& trouble) {
    trouble_ = trouble;
    const double pause = std::clamp(settings_.wait - waited(), 0.0, nextPause_);
    say("waiting for a server at {}:{} ({}), next try in {:.1f} s", settings_.host, settings_.port, trouble_,
        pause);
    // Who has the turn and no server leaves it to the others: else all would lose patience at once.
    turn_.release();
    pause_.set(pause, [this] { queue(); });
    nextPause_ = std::min(nextPause_ * 1.5, kLongestPause);
  }

  void giveUp() {
    const std::string tried =
        fmt::format("at {}:{} after {:.1f} s", settings_.host, settings_.port, waited());
    const bool silent = link_ && link_->greeted != Clock::time_point();
    finish(PlayExit::NoServer,
           silent
               ? fmt::format("no message from the server {}: is it a server for agents? Check --port", tried)
               : fmt::format("no server {} ({}): start it, or check --host and --port", tried, trouble_));
  }

  void greet(const Link& link) {
    link->socket.set_option(tcp::no_delay(true));
    link->socket.non_blocking(true);
    noticeSilentEnd(link->socket.native_handle());
    if (newLife_) nextLife();
    link->greeted = Clock::now();
    send(link, link->session.begin());
    read(link);
    if (settings_.rescue) link->silence.set(kSilenceBeforeSyn, [this] { breakSilence(); });
  }

  void breakSilence() {
    if (finished_) return;
    if (Seconds(Clock::now() - link_->greeted).count() > reconnectAfter_) {
      say("no message in {:.1f} s, connecting anew", reconnectAfter_);
      reconnectAfter_ *= 2.0;
      connect();
      return;
    }
    send(link_, "(syn)");
    link_->silence.set(kSynInterval, [this] { breakSilence(); });
  }

  // -- playing

  void read(const Link& link) {
    link->socket.async_read_some(room(*link), [this, link](std::error_code error, std::size_t count) {
      if (isOver(link)) return;
      if (!error) error = absorb(link, count);
      if (isOver(link)) return;
      if (error) return endOf(link, error);
      reply(link);
      read(link);
    });
  }

  /// A server that has not said anything yet may be about to start, like one that refuses to connect.
  void endOf(const Link& link, std::error_code error) {
    if (link->session.counts().messages > 0 || lastInPlay_) {
      return lose(PlayExit::ServerGone, fmt::format("the server at {}:{} is gone ({})", settings_.host,
                                                    settings_.port, error.message()));
    }
    drop();
    reconnectAfter_ = kSilenceBeforeReconnect;
    retry(fmt::format("it closes the connection without a message: {}", error.message()));
  }

  static asio::mutable_buffer room(Connection& connection) {
    const std::span<char> space = connection.frames.prepare(kReadSize);
    return {space.data(), space.size()};
  }

  /// Takes in what has arrived and all that waits behind it, so that only the newest message gets an answer.
  std::error_code absorb(const Link& link, std::size_t count) {
    std::error_code error;
    while (count > 0) {
      link->frames.received(count);
      while (const auto message = link->frames.next()) {
        if (!message->empty()) receive(*link, *message);
        if (isOver(link)) return {};
      }
      if (link->frames.failed()) {
        lose(PlayExit::Error, fmt::format("{}:{} does not speak our protocol: {}", settings_.host,
                                          settings_.port, link->frames.error()));
        return {};
      }
      count = link->socket.read_some(room(*link), error);
    }
    return error == asio::error::would_block ? std::error_code{} : error;
  }

  void receive(Connection& connection, std::string_view message) {
    if (connection.session.counts().messages == 0) {
      connection.silence.cancel();
      deadline_.cancel();
      turnEnd_.set(kTurnAfterInit, [this] { turn_.release(); });
    }
    if (log_) {
      log_->received(message);
      warn(log_->error());
    }
    connection.session.receive(message);
    if (connection.session.timeStands()) warn(kTimeStands);
    if (trace_) {
      trace_->add(connection.session.agent());
      warn(trace_->error());
    }
    if (painter_) painter_->show(connection.session.agent());
    watchStage(connection);
  }

  void watchStage(Connection& connection) {
    const agent::Session& session = connection.session;
    if (session.stage() == agent::Session::Stage::Refused) {
      lose(PlayExit::Refused, fmt::format("the server did not take {} {} into a team: the number is taken, "
                                          "there are two other teams already, "
                                          "or too many robots of type {} (at most 7 of a type, 9 of two "
                                          "types, and 3 types in a full team)",
                                          settings_.session.agent.team, settings_.session.agent.unum,
                                          settings_.session.agent.robotType));
    } else if (session.stage() == agent::Session::Stage::Playing && !connection.accepted) {
      connection.accepted = true;
      turn_.release();
      const protocol::GameStatus& game = session.percept().game;
      say("connected to {}:{} as {} {} ({})", settings_.host, settings_.port, settings_.session.agent.team,
          game.unum.value_or(0), game.side == protocol::TeamSide::Right ? "right" : "left");
    }
  }

  void reply(const Link& link) {
    if (!link->outbox.empty())
      return;  // the server does not read; the answer to what comes meanwhile will be newer
    const std::string_view answer = link->session.answer();
    if (!answer.empty()) send(link, answer);
  }

  void send(const Link& link, std::string_view text) {
    if (log_) log_->sent(text);
    const bool writing = !link->outbox.empty();
    protocol::appendFrame(link->outbox, text);
    if (!writing) write(link);
  }

  // Mostly one write takes all at once; the rest waits until the server reads on.
  void write(const Link& link) {
    std::error_code error;
    const std::size_t count = link->socket.write_some(asio::buffer(link->outbox), error);
    link->outbox.erase(0, count);
    if (link->outbox.empty()) return;
    if (error && error != asio::error::would_block) {
      link->outbox.clear();  // reading tells the same, and is where it is reported
      return;
    }
    link->socket.async_wait(tcp::socket::wait_write, [this, link](std::error_code failure) {
      if (failure || isOver(link)) return;
      write(link);
      reply(link);
    });
  }

  // -- coming back

  /// The end, unless we have played and are to come back: to a server that is started again, or after a
  /// connection that was cut. Whoever does not get back into play for `wait` seconds gives up.
  void lose(PlayExit exit, const std::string& message) {
    if (finished_) return;
    if (link_->accepted) {
      lastInPlay_ = Clock::now();
      nextPause_ = kFirstPause;
    }
    const bool inTime = lastInPlay_ && Seconds(Clock::now() - *lastInPlay_).count() < settings_.wait;
    if (!settings_.reconnect || !inTime) return finish(exit, message);
    say("{}, coming back", message);
    trouble_ = message;
    newLife_ = newLife_ || link_->session.counts().messages > 0;
    add(link_->session.counts());
    drop();
    turnEnd_.cancel();
    turn_.release();
    reconnectAfter_ = kSilenceBeforeReconnect;
    const double pause = exit == PlayExit::Refused ? kPauseAfterRefusal : nextPause_;
    nextPause_ = std::min(nextPause_ * 1.5, kLongestPause);
    pause_.set(pause, [this] { begin(); });
  }

  /// Its handlers find that they are over.
  void drop() {
    if (!link_) return;
    std::error_code ignored;
    link_->silence.cancel();
    link_->socket.close(ignored);
    link_.reset();
  }

  /// What was counted on the connections before.
  void add(const agent::SessionCounts& counts) {
    counts_.messages += counts.messages;
    counts_.answers += counts.answers;
    counts_.passedOver += counts.passedOver;
    counts_.lostCycles += counts.lostCycles;
    counts_.unknownTokens += counts.unknownTokens;
  }

  // -- recordings

  void openLog(const std::string& path) {
    log_ = std::make_unique<protocol::LogWriter>(path, settings_.recordHeader);
    if (settings_.session.agent.startPose)
      log_->comment(agent::startComment(*settings_.session.agent.startPose));
  }

  /// Each connection in which it hears anything is another life of the agent, so it has a log of its
  /// own: 3.zst, 3.2.zst, 3.3.zst.
  void nextLife() {
    newLife_ = false;
    ++lives_;
    if (!log_) return;
    log_->close();
    warn(log_->error());
    const std::filesystem::path first(settings_.record);
    const std::string name =
        fmt::format("{}.{}{}", first.stem().string(), lives_, first.extension().string());
    try {
      openLog((first.parent_path() / name).string());
    } catch (const protocol::LogError& error) {
      log_.reset();
      warn(fmt::format("{}; it goes on without a log", error.what()));
    }
  }

  /// A full disk does not end a match, but is said when it happens, once, and stands in the report.
  void warn(const std::string& error) {
    if (error.empty() || std::find(warnings_.begin(), warnings_.end(), error) != warnings_.end()) return;
    warnings_.push_back(error);
    complain(error);
  }

  void endRecordings() {
    if (log_) {
      log_->close();
      warn(log_->error());
    }
    if (trace_) {
      trace_->close();
      warn(trace_->error());
    }
  }

  // -- ending

  void finish(PlayExit exit, const std::string& message) {
    if (finished_) return;
    finished_ = true;
    exit_ = exit;
    ending_ = message;
    io_.stop();
  }

  void report() {
    const agent::SessionCounts& counts = counts_;
    if (counts.messages > 0) {
      say("{} messages, {} answered, {} passed over for a newer one, {} cycles without a message, {} unknown "
          "tokens",
          counts.messages, counts.answers, counts.passedOver, counts.lostCycles, counts.unknownTokens);
    }
    if (settings_.report.empty()) return;
    const nlohmann::json json = {{"exit", static_cast<int>(exit_)},
                                 {"messages", counts.messages},
                                 {"answers", counts.answers},
                                 {"passed_over", counts.passedOver},
                                 {"lost_cycles", counts.lostCycles},
                                 {"unknown", counts.unknownTokens},
                                 {"connections", lives_},
                                 {"warnings", warnings_}};
    report_ << json.dump() << "\n";
    if (!report_.flush()) complain(cannotWriteReport());
  }

  std::string cannotWriteReport() const {
    return fmt::format("--report {}: cannot be written ({})", settings_.report, std::strerror(errno));
  }

  // The disk that the output goes to may be full: that must not end a match, nor decide its exit code.
  static void write(std::FILE* stream, const std::string& line) {
    std::fputs((line + "\n").c_str(), stream);
    std::fflush(stream);
    std::clearerr(stream);
  }

  static void complain(const std::string& message) { write(stderr, "nonet play: " + message); }

  template <class... Arguments>
  void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    if (settings_.quiet) return;
    write(stdout, fmt::format(format, std::forward<Arguments>(arguments)...));
  }

  PlaySettings settings_;
  Turn turn_;
  asio::io_context io_{1};
  asio::signal_set signals_;
  tcp::resolver resolver_{io_};
  Alarm pause_{io_};     // until the next look for a turn or for a server
  Alarm turnEnd_{io_};   // until the turn is given back at the latest
  Alarm deadline_{io_};  // for the first message
  std::unique_ptr<protocol::LogWriter> log_;
  std::ofstream report_;
  std::unique_ptr<TraceFile> trace_;
  std::unique_ptr<RobovizPainter> painter_;
  Link link_;
  agent::SessionCounts counts_;
  Clock::time_point started_;      // to look for a server
  Clock::time_point queuedSince_;  // for a turn
  bool searches_ = false;          // has had its first turn
  std::optional<Clock::time_point> lastInPlay_;
  int lives_ = 1;
  bool newLife_ = false;               // with the next connection
  std::string trouble_ = "no answer";  // why the last attempt to connect failed
  double nextPause_ = kFirstPause;
  double reconnectAfter_ = kSilenceBeforeReconnect;
  std::vector<std::string> warnings_;  // of recordings that are not whole
  bool finished_ = false;
  PlayExit exit_ = PlayExit::Stopped;
  std::string ending_;  // why it ended
};

}  // namespace

PlayExit play(const PlaySettings& settings) {
  return PlayClient(settings).run();
}

}  // namespace nonet::app
