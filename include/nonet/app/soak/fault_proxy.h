// Stands between one agent and the server and spoils the connection when told: cuts it, cuts it within a
// message, delays or repeats messages. In a thread of its own.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

namespace nonet::app {

class FaultProxy {
 public:
  /// Listens on a free port of this machine for agents of the server at `serverPort`.
  explicit FaultProxy(int serverPort);
  ~FaultProxy();
  FaultProxy(const FaultProxy&) = delete;
  FaultProxy& operator=(const FaultProxy&) = delete;

  int port() const;

  // From any thread; all act on the connections that are there.
  void cut();
  /// A length of 500 bytes and the first ten of them, to both sides; then cut.
  void cutWithinMessage();
  /// Every message in both directions comes so much later, in s.
  void delay(double seconds) { delay_ = seconds; }
  /// Every message in both directions comes twice.
  void repeat(bool on) { repeat_ = on; }

  struct Implementation;

 private:
  std::atomic<double> delay_{0.0};
  std::atomic<bool> repeat_{false};
  std::unique_ptr<Implementation> implementation_;
  std::thread thread_;
};

}  // namespace nonet::app
