// Looks at the CAN interface ten times a second and carries out what the car wants done to it, in a
// thread of its own: the kernel answers about interfaces under one lock, and a restart may take a
// second, neither of which the 100 Hz loop can wait for.
//
//   loop    newest() ---- restart() ------------------------------ newest()
//   thread  look .. look .  IFLA_CAN_RESTART or down and up, look . look ..
//
//   in     an interface name; requests. A request made while the same is under way is one with it
//   out    the newest report, never waited for; counters of what was done and refused
//   errors start(): Problem with the interface as place. A refusal is counted and its reason kept
//   cost   newest(): no system call; restart(), flush(): one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>

#include "protocol/transport/can/can_interface.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::io {

struct BusReport {
  transport::CanInterfaceStatus interface;
  std::uint64_t restarts = 0, restarts_refused = 0;
  std::uint64_t down_and_up = 0;  // of the restarts: those the kernel does not count
  std::uint64_t flushes = 0, flushes_refused = 0;
  std::array<char, 160> refusal{};  // why the last one was refused; text ends at the first zero
};

class BusWatch {
 public:
  static Result<std::unique_ptr<BusWatch>, Problem> start(std::string_view interface);
  ~BusWatch();
  BusWatch(const BusWatch&) = delete;
  BusWatch& operator=(const BusWatch&) = delete;

  // Valid until the next call; for one thread only.
  const BusReport& newest();
  void restart() { ask(restart_asked_); }
  void flush() { ask(flush_asked_); }
  // A flush is asked for or under way, so frames may vanish at any moment.
  bool flushing() const { return flush_asked_.load(); }

 private:
  BusWatch(transport::CanInterface interface, transport::FileDescriptor bell);
  void ask(std::atomic<bool>& request);
  void serve();
  void carry_out_restart();
  bool count(const std::optional<Problem>& refused, std::uint64_t& done, std::uint64_t& refusals);
  void carry_out_flush();
  void publish();

  transport::CanInterface interface_;
  transport::FileDescriptor bell_;
  std::atomic<bool> restart_asked_{false}, flush_asked_{false}, end_{false};
  BusReport mine_;  // the thread's
  std::mutex shared_lock_;
  BusReport shared_;
  BusReport seen_;  // the caller's
  std::thread thread_;
};

}  // namespace pitwall::io
