// Which run of a sender is listened to. A sender numbers its starts; a newer run begins afresh at
// once, an older one only after kSilence without an accepted packet of the present run, so that two
// senders, or what was late on its way, do not alternate.
//   in     the run that a packet names and when it was received
//   law    runs are compared modulo 2^32: half of the circle is newer
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

class RunFilter {
 public:
  enum class Verdict : std::uint8_t { kSame, kBegun, kOther };
  static constexpr Duration kSilence = seconds(2);

  constexpr Verdict judge(std::uint32_t run, Instant at) {
    if (started_ && run == run_) return Verdict::kSame;
    const bool newer = std::bit_cast<std::int32_t>(run - run_) > 0;
    if (started_ && !newer && at - last_accepted_ < kSilence) return Verdict::kOther;
    started_ = true;
    run_ = run;
    return Verdict::kBegun;
  }
  constexpr void accepted(Instant at) { last_accepted_ = at; }

 private:
  bool started_ = false;
  std::uint32_t run_ = 0;
  Instant last_accepted_{};
};

// A number for a run that begins now: rises by one every 17 ms, so that two starts never share one,
// and passes half of its circle in more than a year.
constexpr std::uint32_t run_number(Duration since_epoch) {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(since_epoch.ns) >> 24U);
}

}  // namespace pitwall::telemetry
