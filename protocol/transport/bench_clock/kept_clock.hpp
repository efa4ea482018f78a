// Keeper of bench time in its own thread, for several benches and programs that share one file.
//   in     path of the file
//   out    bench time, until end() or destruction
//   errors keep(): Problem with the file, or if another process keeps it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <thread>

#include "protocol/transport/bench_clock/clock_keeper.hpp"

namespace pitwall::transport {

class KeptClock {
 public:
  static Result<KeptClock, Problem> keep(const std::string& path);
  KeptClock(KeptClock&&) = default;
  KeptClock& operator=(KeptClock&&) = delete;
  ~KeptClock();

  // Ends bench time and returns the record of the waits; empty at a second call.
  ClockWaits end();

 private:
  explicit KeptClock(std::unique_ptr<ClockKeeper> keeper);

  std::unique_ptr<ClockKeeper> keeper_;
  std::jthread thread_;  // last: it ends first
};

}  // namespace pitwall::transport
