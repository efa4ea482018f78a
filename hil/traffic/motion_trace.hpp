// Trace of a car over the last seconds, speed and offset: what it did before a contact.
//   in     the true pose of the car, in order of time
//   out    samples kTraceStep apart or more, the newest first; the oldest is at least kTraceSpan
//          older than the newest as soon as the car has driven that long
//   cost   O(1), no allocation; trivially copyable
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "hil/plant/car_pose.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::traffic {

inline constexpr Duration kTraceStep = milliseconds(50);
inline constexpr Duration kTraceSpan = milliseconds(1'500);

struct TraceSample {
  Instant at{};
  double speed_mps = kUnset, n_m = kUnset;
};

class MotionTrace {
 public:
  // Leaves out what comes sooner than kTraceStep after the last sample.
  void record(const plant::CarPose& car, Instant now);
  std::size_t size() const { return size_; }
  const TraceSample& sample(std::size_t i) const;  // 0: the newest; i < size()

 private:
  static constexpr std::size_t kSamples = static_cast<std::size_t>(kTraceSpan / kTraceStep) + 2;
  std::array<TraceSample, kSamples> ring_{};
  std::size_t next_ = 0, size_ = 0;
};

double speed_mps(const plant::CarPose& car);

}  // namespace pitwall::traffic
