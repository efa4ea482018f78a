// The same frames in other orders of arrival: what the tracker knows in the end must not change.
//   in     a scene of some seconds, parameters, how many orders
//   out    the largest difference of any value of any car, its covariance included, against the
//          arrival in the order of measurement; infinite where another number of cars came out.
//          Cars are compared with the nearest: their numbers are given when they are published
//          first, which depends on what had arrived by then
//   orders each frame arrives up to kLateMost after its measurement, at random; in the last order
//          all of the last kLateMost come at the end, the newest first
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "tests/benchmarks/tracking/tracking_plan.hpp"
#include "vehicle/autonomy/tracking/tracking.hpp"

namespace pitwall::tracking_bench {

inline constexpr Duration kLateMost = milliseconds(900);  // below the tracker's window of 1 s

struct OrdersResult {
  std::size_t orders = 0, cars = 0, frames = 0;
  double worst = 0.0;
};

OrdersResult compare_orders(const Scene& scene, const tracking::Params& params, std::size_t orders);

}  // namespace pitwall::tracking_bench
