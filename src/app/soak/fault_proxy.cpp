#include "nonet/app/soak/fault_proxy.h"

#include <chrono>
#include <deque>
#include <list>
#include <string>

#include <asio.hpp>

#include "nonet/protocol/framing.h"

namespace nonet::app {
namespace {

using asio::ip::tcp;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTick{2};

/// One direction: messages that wait for their time.
struct Lane {
  struct Waiting {
    Clock::time_point due;
    std::string frame;
  };
  protocol::FrameReader frames;
  std::deque<Waiting> waiting;
};

struct Pair {
  explicit Pair(asio::io_context& io) : agent(io), server(io) {}
  tcp::socket agent;
  tcp::socket server;
  Lane toServer;
  Lane toAgent;
  bool dead = false;

  void close() {
    std::error_code ignored;
    agent.close(ignored);
    server.close(ignored);
    dead = true;
  }
};

}  // namespace

struct FaultProxy::Implementation {
  Implementation(FaultProxy& proxy, int port)
      : owner(proxy), serverPort(port), acceptor(io, {asio::ip::address_v4::loopback(), 0}), ticker(io) {
    accept();
    tick();
  }

  void accept() {
    acceptor.async_accept([this](std::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error) admit(std::move(socket));
      accept();
    });
  }

  void admit(tcp::socket socket) {
    auto pair = std::make_shared<Pair>(io);
    std::error_code error;
    pair->server.connect({asio::ip::address_v4::loopback(), static_cast<asio::ip::port_type>(serverPort)},
                         error);
    if (error) return;  // the agent's end closes with `socket`
    pair->agent = std::move(socket);
    for (tcp::socket* end : {&pair->agent, &pair->server}) end->set_option(tcp::no_delay(true), error);
    pairs.push_back(pair);
    read(pair, pair->agent, pair->server, pair->toServer);
    read(pair, pair->server, pair->agent, pair->toAgent);
  }

  void read(const std::shared_ptr<Pair>& pair, tcp::socket& from, tcp::socket& to, Lane& lane) {
    const std::span<char> room = lane.frames.prepare(65536);
    from.async_read_some(asio::buffer(room.data(), room.size()),
                         [this, pair, &from, &to, &lane](std::error_code error, std::size_t count) {
                           if (pair->dead) return;
                           if (error) return pair->close();
                           lane.frames.received(count);
                           queue(lane);
                           forward(*pair, to, lane);
                           if (!pair->dead) read(pair, from, to, lane);
                         });
  }

  void queue(Lane& lane) const {
    const auto pause =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(owner.delay_));
    while (const auto message = lane.frames.next()) {
      std::string frame;
      protocol::appendFrame(frame, *message);
      // Nothing overtakes when a delay ends.
      Clock::time_point due = Clock::now() + pause;
      if (!lane.waiting.empty()) due = std::max(due, lane.waiting.back().due);
      lane.waiting.push_back({due, frame});
      if (owner.repeat_) lane.waiting.push_back({due, frame});
    }
  }

  static void forward(Pair& pair, tcp::socket& to, Lane& lane) {
    while (!pair.dead && !lane.waiting.empty() && lane.waiting.front().due <= Clock::now()) {
      std::error_code error;
      asio::write(to, asio::buffer(lane.waiting.front().frame), error);
      lane.waiting.pop_front();
      if (error) pair.close();
    }
  }

  void tick() {
    ticker.expires_after(kTick);
    ticker.async_wait([this](std::error_code error) {
      if (error) return;
      for (const auto& pair : pairs) {
        forward(*pair, pair->server, pair->toServer);
        forward(*pair, pair->agent, pair->toAgent);
      }
      pairs.remove_if([](const auto& pair) { return pair->dead; });
      tick();
    });
  }

  void cut(const std::string& lastBytes) {
    for (const auto& pair : pairs) {
      if (pair->dead) continue;
      std::error_code ignored;
      asio::write(pair->agent, asio::buffer(lastBytes), ignored);
      asio::write(pair->server, asio::buffer(lastBytes), ignored);
      pair->close();
    }
  }

  FaultProxy& owner;
  int serverPort;
  asio::io_context io;
  tcp::acceptor acceptor;
  asio::steady_timer ticker;
  std::list<std::shared_ptr<Pair>> pairs;
};

FaultProxy::FaultProxy(int serverPort)
    : implementation_(std::make_unique<Implementation>(*this, serverPort)),
      thread_([this] { implementation_->io.run(); }) {}

FaultProxy::~FaultProxy() {
  implementation_->io.stop();
  thread_.join();
}

int FaultProxy::port() const {
  return implementation_->acceptor.local_endpoint().port();
}

void FaultProxy::cut() {
  asio::post(implementation_->io, [this] { implementation_->cut(""); });
}

void FaultProxy::cutWithinMessage() {
  constexpr std::size_t kLength = 500;
  const auto header = protocol::frameHeader(kLength);
  const std::string half = std::string(header.begin(), header.end()) + "(time (now";
  asio::post(implementation_->io, [this, half] { implementation_->cut(half); });
}

}  // namespace nonet::app
