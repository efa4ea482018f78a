// Processor time of the tracker with six cars around us.
//   in     ticks of a scene with one LiDAR, all six cars always in its sight
//   out    of a step with a frame that is on time, and with one that is kRewind late while all
//          others are on time: p50 and p99 over the ticks, each the least of kCostBlocks passes;
//          the same of all nine sensors as they arrive (figures only); allocations of all steps
//   units  processor time of the calling thread
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "tests/benchmarks/cost/cost_gates.hpp"
#include "tests/benchmarks/cost/quantiles.hpp"
#include "vehicle/autonomy/tracking/tracking.hpp"

namespace pitwall::tracking_bench {

inline constexpr int kCostBlocks = 5;
inline constexpr Duration kRewind = milliseconds(980);
inline constexpr std::size_t kCostCars = 6;

struct TrackingCost {
  std::string method;
  benchmarks::Quantiles update, rewind, all_sensors;
  std::size_t cars_least = 0;  // in a timed step
  std::size_t steps = 0, allocations = 0;
  double unit_us = 0.0;
};

TrackingCost measure_tracking_cost(const tracking::Params& params, Duration span);

// On the reference machine: 30 us for an update, 150 us for a rewind, each at p99; no allocation.
cost::CostGates gates_of(const TrackingCost& measured);

std::string to_text(const TrackingCost& measured);

}  // namespace pitwall::tracking_bench
