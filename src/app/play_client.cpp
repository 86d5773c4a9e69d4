#include "nonet/app/play_client.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <span>

#include <asio.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/agent/agent_setup.h"
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
constexpr double kTurnAfterInit = 0.5;    // s; a server that collects whole teams first accepts nobody before
constexpr double kFirstPause = 0.1;       // s between two attempts to connect, grows by half each time
constexpr double kLongestPause = 2.0;     // s
constexpr std::size_t kReadSize = 65536;  // bytes

class PlayClient {
 public:
  explicit PlayClient(const PlayOptions& options)
      : options_(options),
        session_(options.session),
        turn_(options.host, options.port),
        signals_(io_, SIGINT, SIGTERM) {
    if (!options.draw.empty()) painter_ = std::make_unique<RobovizPainter>(options.draw);
    if (!options.trace.empty()) trace_ = std::make_unique<TraceFile>(options.trace);
    if (!options.record.empty()) {
      log_ = std::make_unique<protocol::LogWriter>(options.record, options.recordHeader);
      if (options.session.agent.startPose)
        log_->comment(agent::startComment(*options.session.agent.startPose));
    }
  }

  PlayExit run() {
    signals_.async_wait([this](std::error_code error, int signal) {
      if (!error) finish(PlayExit::Stopped, fmt::format("stopped by signal {}", signal));
    });
    started_ = Clock::now();
    asio::post(io_, [this] { awaitTurn(); });
    io_.run();
    if (log_) {
      log_->close();
      if (log_->failed()) fmt::print(stderr, "nonet play: {}\n", log_->error());
    }
    report();
    return exit_;
  }

 private:
  using Timer = asio::steady_timer;

  template <class Action>
  void after(Timer& timer, double seconds, Action action) {
    timer.expires_after(std::chrono::duration_cast<Clock::duration>(Seconds(seconds)));
    timer.async_wait([this, action](std::error_code error) {
      if (!error && !finished_) action();
    });
  }

  // -- connecting

  void awaitTurn() {
    const double patience = kTurnPatience + kTurnPatiencePerUnum * options_.session.agent.unum;
    if (options_.atOnce || turn_.take() || Seconds(Clock::now() - started_).count() > patience) {
      started_ = Clock::now();  // waiting for the others does not count as waiting for the server
      connect();
    } else {
      after(pauseTimer_, kTurnInterval, [this] { awaitTurn(); });
    }
  }

  void connect() {
    std::error_code error;
    const auto endpoints = resolver_.resolve(options_.host, std::to_string(options_.port), error);
    if (error) {
      retry(error);
      return;
    }
    asio::async_connect(socket_, endpoints, [this](std::error_code failure, const tcp::endpoint&) {
      if (finished_) return;
      if (failure) {
        retry(failure);
      } else {
        greet();
      }
    });
  }

  void retry(std::error_code error) {
    const double waited = Seconds(Clock::now() - started_).count();
    if (waited + pause_ > options_.wait) {
      finish(PlayExit::NoServer,
             fmt::format("no server at {}:{} after {:.1f} s ({}): start it, or check --host and --port",
                         options_.host, options_.port, waited, error.message()));
      return;
    }
    say("waiting for a server at {}:{} ({}), next try in {:.1f} s", options_.host, options_.port,
        error.message(), pause_);
    after(pauseTimer_, pause_, [this] { connect(); });
    pause_ = std::min(pause_ * 1.5, kLongestPause);
  }

  void greet() {
    socket_.set_option(tcp::no_delay(true));
    socket_.non_blocking(true);
    frames_.reset();
    send(session_.begin());
    read();
    watchSilence();
  }

  void watchSilence() {
    if (!options_.rescue) return;
    greeted_ = Clock::now();
    after(silenceTimer_, kSilenceBeforeSyn, [this] { breakSilence(); });
  }

  void breakSilence() {
    if (Seconds(Clock::now() - greeted_).count() > reconnectAfter_) {
      reconnect();
      return;
    }
    send("(syn)");
    after(silenceTimer_, kSynInterval, [this] { breakSilence(); });
  }

  void reconnect() {
    say("no message in {:.1f} s, connecting anew", reconnectAfter_);
    reconnectAfter_ *= 2.0;
    ++connection_;
    std::error_code ignored;
    socket_.close(ignored);
    outbox_.clear();
    connect();
  }

  // -- playing

  void read() {
    socket_.async_read_some(
        room(), [this, connection = connection_](std::error_code error, std::size_t count) {
          if (finished_ || connection != connection_) return;
          if (!error) error = absorb(count);
          if (finished_) return;
          if (error) {
            finish(PlayExit::ServerGone, fmt::format("the server at {}:{} is gone ({})", options_.host,
                                                     options_.port, error.message()));
            return;
          }
          reply();
          read();
        });
  }

  asio::mutable_buffer room() {
    const std::span<char> space = frames_.prepare(kReadSize);
    return {space.data(), space.size()};
  }

  /// Takes in what has arrived and all that waits behind it, so that only the newest message gets an answer.
  std::error_code absorb(std::size_t count) {
    std::error_code error;
    while (count > 0) {
      frames_.received(count);
      while (const auto message = frames_.next()) {
        if (!message->empty()) receive(*message);
        if (finished_) return {};
      }
      if (frames_.failed()) {
        finish(PlayExit::Error, fmt::format("{}:{} does not speak our protocol: {}", options_.host,
                                            options_.port, frames_.error()));
        return {};
      }
      count = socket_.read_some(room(), error);
    }
    return error == asio::error::would_block ? std::error_code{} : error;
  }

  void receive(std::string_view message) {
    if (session_.counts().messages == 0) {
      silenceTimer_.cancel();
      after(pauseTimer_, kTurnAfterInit, [this] { turn_.release(); });
    }
    if (log_) log_->received(message);
    session_.receive(message);
    if (trace_) trace_->add(session_.agent());
    if (painter_) painter_->show(session_.agent());
    watchStage();
  }

  void watchStage() {
    if (session_.stage() == agent::Session::Stage::Refused) {
      finish(PlayExit::Refused, fmt::format("the server did not take {} {} into a team: the number is taken, "
                                            "there are two other teams already, "
                                            "or too many robots of type {} (at most 7 of a type, 9 of two "
                                            "types, and 3 types in a full team)",
                                            options_.session.agent.team, options_.session.agent.unum,
                                            options_.session.agent.robotType));
    } else if (session_.stage() == agent::Session::Stage::Playing && !accepted_) {
      accepted_ = true;
      turn_.release();
      const protocol::GameStatus& game = session_.percept().game;
      say("connected to {}:{} as {} {} ({})", options_.host, options_.port, options_.session.agent.team,
          game.unum.value_or(0), game.side == protocol::TeamSide::Right ? "right" : "left");
    }
  }

  void reply() {
    if (!outbox_.empty())
      return;  // the server does not read; the answer to what comes meanwhile will be newer
    const std::string_view answer = session_.answer();
    if (!answer.empty()) send(answer);
  }

  void send(std::string_view text) {
    if (log_) log_->sent(text);
    const bool writing = !outbox_.empty();
    protocol::appendFrame(outbox_, text);
    if (!writing) write();
  }

  // Mostly one write takes all at once; the rest waits until the server reads on.
  void write() {
    std::error_code error;
    const std::size_t count = socket_.write_some(asio::buffer(outbox_), error);
    outbox_.erase(0, count);
    if (outbox_.empty()) return;
    if (error && error != asio::error::would_block) {
      outbox_.clear();  // reading tells the same, and is where it is reported
      return;
    }
    socket_.async_wait(tcp::socket::wait_write, [this, connection = connection_](std::error_code failure) {
      if (finished_ || failure || connection != connection_) return;
      write();
      reply();
    });
  }

  // -- ending

  void finish(PlayExit exit, const std::string& message) {
    if (finished_) return;
    finished_ = true;
    exit_ = exit;
    if (exit == PlayExit::Stopped) {
      say("{}", message);
    } else {
      fmt::print(stderr, "nonet play: {}\n", message);
    }
    io_.stop();
  }

  void report() {
    const agent::SessionCounts& counts = session_.counts();
    if (counts.messages > 0) {
      say("{} messages, {} answered, {} passed over for a newer one, {} cycles without a message, {} unknown "
          "tokens",
          counts.messages, counts.answers, counts.passedOver, counts.lostCycles, counts.unknownTokens);
    }
    if (options_.report.empty()) return;
    const nlohmann::json json = {{"exit", static_cast<int>(exit_)},  {"messages", counts.messages},
                                 {"answers", counts.answers},        {"passed_over", counts.passedOver},
                                 {"lost_cycles", counts.lostCycles}, {"unknown", counts.unknownTokens}};
    std::ofstream(options_.report) << json.dump() << "\n";
  }

  template <class... Arguments>
  void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    if (options_.quiet) return;
    fmt::print("{}\n", fmt::format(format, std::forward<Arguments>(arguments)...));
    std::fflush(stdout);
  }

  PlayOptions options_;
  agent::Session session_;
  Turn turn_;
  asio::io_context io_{1};
  asio::signal_set signals_;
  tcp::resolver resolver_{io_};
  tcp::socket socket_{io_};
  Timer pauseTimer_{io_};
  Timer silenceTimer_{io_};
  protocol::FrameReader frames_;
  std::unique_ptr<protocol::LogWriter> log_;
  std::unique_ptr<TraceFile> trace_;
  std::unique_ptr<RobovizPainter> painter_;
  std::string outbox_;  // frames not yet taken by the socket
  Clock::time_point started_;
  Clock::time_point greeted_;
  double pause_ = kFirstPause;
  double reconnectAfter_ = kSilenceBeforeReconnect;
  int connection_ = 0;  // counts connections, so that late events of an old one are told apart
  bool accepted_ = false;
  bool finished_ = false;
  PlayExit exit_ = PlayExit::Stopped;
};

}  // namespace

PlayExit play(const PlayOptions& options) {
  return PlayClient(options).run();
}

}  // namespace nonet::app
