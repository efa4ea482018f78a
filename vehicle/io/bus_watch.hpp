// Monitor of the CAN interface, ten times a second, and executor of restarts and flushes, in a
// thread of its own. The kernel serves interface requests under one lock, and a restart may take a
// second: the 100 Hz loop cannot wait for either.
//
//   loop    newest() ---- restart() ------------------------------ newest()
//   thread  read .. read .  IFLA_CAN_RESTART or down and up, read . read ..
//
//   in     an interface name; requests. A request that is made while the same one runs is merged
//          with it
//   out    the newest report, without waiting; counters of executed and refused requests
//   errors start(): Problem with the interface as place. A refusal is counted, and its reason is
//          kept
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
  std::uint64_t down_and_up = 0;  // restarts that the kernel does not count
  std::uint64_t flushes = 0, flushes_refused = 0;
  std::array<char, 160> refusal{};  // reason of the last refusal, zero-terminated
};

class BusWatch {
 public:
  static Result<std::unique_ptr<BusWatch>, Problem> start(std::string_view interface);
  ~BusWatch();
  BusWatch(const BusWatch&) = delete;
  BusWatch& operator=(const BusWatch&) = delete;

  // Valid until the next call; for one thread only.
  const BusReport& newest();
  void restart() { raise(restart_asked_); }
  void flush() { raise(flush_asked_); }
  // A flush is requested or running, so frames may vanish at any moment.
  bool flushing() const { return flush_asked_.load(); }

 private:
  BusWatch(transport::CanInterface interface, transport::FileDescriptor wake_fd);
  void raise(std::atomic<bool>& request);
  void serve();
  void carry_out_restart();
  bool count(const std::optional<Problem>& refused, std::uint64_t& done, std::uint64_t& refusals);
  void carry_out_flush();
  void publish();

  transport::CanInterface interface_;
  transport::FileDescriptor wake_fd_;
  std::atomic<bool> restart_asked_{false}, flush_asked_{false}, end_{false};
  BusReport own_;  // of the thread
  std::mutex shared_lock_;
  BusReport shared_;
  BusReport seen_;  // of the caller
  std::thread thread_;
};

}  // namespace pitwall::io
