// Table, JSON and gates of the tracking benchmark: a row per scene and tracker.
//   gates  of ours; each is printed with its figure
//          race   position, rms of the distance: 0.10 m within 60 m, 0.25 m between 90 and 110 m;
//                 speed 0.5 m/s rms; no identity switch; MOTA 0.98; consistent: 0.93 of the errors
//                 within the ellipsoid of 95 %, and a mean NEES of 2 at least (4 is expected: no
//                 variance is twice too large)
//          pair   no identity switch, MOTA 0.98
//          blind  1.5 m at most at the end of 1.5 s, no car lost
//          orders the result of every order of arrival within 1e-9
//   source the bounds were given before a tracker was written; 0.93 leaves 2 % for maneuvers, which
//          are not of a normal distribution
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/benchmarks/tracking/arrival_orders.hpp"
#include "tests/benchmarks/tracking/tracking_run.hpp"

namespace pitwall::tracking_bench {

inline constexpr double kNearRms_m = 0.10, kFarRms_m = 0.25, kSpeedRms_mps = 0.5;
inline constexpr double kMota = 0.98, kWithin95 = 0.93, kNeesMean = 2.0;
inline constexpr double kBlind_m = 1.5, kOrders = 1e-9;

struct Gate {
  std::string name, figure;
  bool held = false;
};

// Of the rows of our method, one per scene; a scene that is missing holds no gate.
std::vector<Gate> gates_of(const std::vector<TrackingRow>& rows, const OrdersResult& orders);

std::string to_text(const std::vector<TrackingRow>& rows);
std::string to_text(const std::vector<Gate>& gates);
std::string to_json(const std::vector<TrackingRow>& rows);
std::string to_json(const std::vector<Gate>& gates);

}  // namespace pitwall::tracking_bench
