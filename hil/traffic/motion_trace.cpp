// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/motion_trace.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::traffic {

double speed_mps(const plant::CarPose& car) { return std::hypot(car.vx_mps, car.vy_mps); }

void MotionTrace::record(const plant::CarPose& car, Instant now) {
  if (size_ > 0 && now - sample(0).at < kTraceStep) return;
  ring_[next_] = {.at = now, .speed_mps = speed_mps(car), .n_m = car.n_m};
  next_ = (next_ + 1) % kSamples;
  size_ = std::min(size_ + 1, kSamples);
}

const TraceSample& MotionTrace::sample(std::size_t i) const {
  CHECK(i < size_);
  return ring_[(next_ + kSamples - 1 - i) % kSamples];
}

}  // namespace pitwall::traffic
