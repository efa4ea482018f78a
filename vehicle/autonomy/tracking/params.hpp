// Parameters of the tracker with their legal ranges: the method, which detections are used, and
// both filters.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/autonomy/tracking/filter/filter_params.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::tracking {

// kPaper: the published baseline, for comparison.
enum class Method : std::uint8_t { kPaper, kRoad };
inline constexpr std::array<const char*, 2> kMethodNames{"paper", "road"};

struct Params {
  Method method = Method::kRoad;
  double confidence_min = 0.3;  // a detection below it is refused
  double window_s = 1.0;        // largest age of a frame on arrival
  double ahead_max_s = 0.005;   // a frame that is further in the future is refused
  double reach_m = 300.0;       // largest distance of a detection
  double wall_margin_m = 1.0;   // a detection further beyond a wall is refused
  double own_length_m = 4.92, own_width_m = 1.93;  // a detection inside of our own car is refused
  double coast_s = 5.0;                            // without a detection a track ends after it
  RoadParams road;
  PaperParams paper;
};

inline constexpr auto kRanges = std::to_array<world::NamedRange<Params>>({
    {"confidence_min", &Params::confidence_min, 0.0, 1.0},
    {"window_s", &Params::window_s, 0.05, 1.0},
    {"ahead_max_s", &Params::ahead_max_s, 0.0, 0.05},
    {"reach_m", &Params::reach_m, 20.0, 500.0},
    {"wall_margin_m", &Params::wall_margin_m, 0.0, 10.0},
    {"own_length_m", &Params::own_length_m, 1.0, 6.0},
    {"own_width_m", &Params::own_width_m, 0.5, 2.5},
    {"coast_s", &Params::coast_s, 0.2, 10.0},
});

// At start-up: checks every parameter against its legal range; the place of a Problem is the name
// of the parameter.
Result<Params, Problem> checked(const Params& params);

}  // namespace pitwall::tracking
