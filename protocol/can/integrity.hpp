// Is a message alive? Without a checksum on this bus, that is: its counter changes and it comes in
// time. Senders wrap their counters at 7, 9, 15 or 255, so what is asked of a counter is that it
// changes; a step of more than one is told apart, because lost and foreign frames look like that.
//   in      counter values and times of reception
//   out     a verdict per frame and a leaky bucket over them: +1 for a bad frame, -1 for a good one
//   units   Instant and Duration of the caller's clock
//   source  commaai/opendbc safety.h (leaky bucket, limit 5)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/can/frame.hpp"
#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::can {

enum class CounterVerdict : std::uint8_t {
  kFirst,    // nothing to compare with
  kChanged,  // one more than before, or restarted at 0 or 1
  kStuck,    // the same as before: bad
  kJumped,   // any other change: bad where the rule says so
};

struct CounterRule {
  std::uint8_t bits = 8;
  bool jump_is_bad = true;
};

struct CounterMonitor {
  static constexpr std::uint8_t kDegraded = 3;  // bad frames more than good ones
  static constexpr std::uint8_t kFault = 5;

  std::optional<std::uint32_t> last;
  std::uint8_t debt = 0;  // 0 to kFault

  bool is_degraded() const { return debt >= kDegraded; }
  bool is_fault() const { return debt >= kFault; }
};

// Updates the monitor with the counter of one received frame.
CounterVerdict judge(CounterMonitor& monitor, std::uint32_t value, CounterRule rule = {});

// The counter of a frame of this row; the row must have one.
std::uint32_t counter_of(const MessageRow& row, const Frame& frame);

enum class Liveness : std::uint8_t {
  kNever,  // not heard yet
  kFresh,  // within 2.5 periods
  kLate,   // later than that
  kLost,   // later than the timeout of the row
};

Liveness liveness(const MessageRow& row, std::optional<Instant> heard, Instant now);

}  // namespace pitwall::can
