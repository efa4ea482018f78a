// Budget for busy waiting: a quarter of all time, at most kMost at once. The kernel stops a
// real-time thread that is never idle (sched_rt_runtime_us: 50 ms of every second), and on a
// machine with one processor other threads need it.
//   in     times that never decrease, the time spent busy
//   out    whether there is credit
//   invariants
//          between any two instants at most kMost plus a quarter of the time between them is spent,
//          apart from the last wait that began with credit
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::replay {

class BusyBudget {
 public:
  static constexpr std::int64_t kShare = 4;
  static constexpr Duration kMost = milliseconds(5);

  bool has_credit(Instant now) {
    if (begun_) credit_ = std::min(kMost, credit_ + (now - last_) / kShare);
    begun_ = true;
    last_ = now;
    return credit_ > Duration{};
  }
  void spend(Duration busy) { credit_ = credit_ - busy; }

 private:
  Duration credit_ = kMost;
  Instant last_{};
  bool begun_ = false;
};

}  // namespace pitwall::replay
