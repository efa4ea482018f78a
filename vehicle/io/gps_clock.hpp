// The car's clock in terms of a receiver's: which Instant was this GPS time?
//   in     pairs (GPS time of a sample, when its bytes arrived), in order of arrival
//   out    the Instant of a GPS time, never later than the arrival
//   method offset = the smallest (arrival - GPS time) of the last 8 to 16 seconds: transport and
//          computing can only add delay, so the smallest is the truest. What is left is the
//          smallest delay itself, about that of the quickest message (an IMU sample, 2 ms).
//   errors a step of GPS time to the future is believed after kConfirmations agreeing samples; to
//          the past it looks like delay and is believed when the window has passed. Until then
//          samples look older than they are, never younger.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/gnss/gps_time.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::io {

class GpsClock {
 public:
  static constexpr Duration kHalfWindow = seconds(8);
  static constexpr Duration kStep = milliseconds(500);  // less is delay that got smaller
  static constexpr int kConfirmations = 5;

  // Empty while a step is not yet believed: the sample must not be used.
  std::optional<Instant> place(gnss::GpsTime sampled, Instant arrival);

  std::uint64_t steps() const { return steps_; }  // believed ones

 private:
  void note(Duration difference, Instant arrival);
  Duration offset() const { return current_ < previous_ ? current_ : previous_; }
  bool refuse(Duration difference);

  bool started_ = false;
  // Smallest difference of this half window and of the one before.
  Duration current_{}, previous_{};
  Instant half_began_{};
  Duration suspect_{};
  int confirmations_ = 0;
  std::uint64_t steps_ = 0;
};

}  // namespace pitwall::io
