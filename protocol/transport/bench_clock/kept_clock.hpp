// Keeper of bench time in a thread of its own, for several benches and programs that share one
// file.
//   in     the file
//   out    bench time from here to the end of its life
//   errors keep(): Problem with the file, or another keeps it
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

  // Ends it and says what was waited for.
  ClockWaits end();

 private:
  explicit KeptClock(std::unique_ptr<ClockKeeper> keeper);

  std::unique_ptr<ClockKeeper> keeper_;
  std::jthread thread_;  // last: it ends first
};

}  // namespace pitwall::transport
