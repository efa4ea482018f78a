// Cross-track error statistics by speed bracket, beside the figures of the paper, and by lap.
//   in     one pair (speed, cross-track error) per tick at a constant rate, with the laps finished
//          before it; a NaN is only counted
//   out    mean and maximum of the absolute error per bracket, per lap and overall above 10 m/s
//   units  m, m/s; a speed on a boundary belongs to the faster bracket
//   source Saba et al., Fast and Modular Autonomy Software for Autonomous Racing Vehicles: best and
//          mean of three runs of season one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::grading {

struct Bracket {
  double from_mps, to_mps;
  double paper_best_m, paper_mean_m;
};

inline constexpr std::array kBrackets{
    Bracket{60.0, 1e9, 0.540, 0.689},  Bracket{55.0, 60.0, 0.457, 0.832},
    Bracket{50.0, 55.0, 0.479, 0.653}, Bracket{45.0, 50.0, 0.412, 0.519},
    Bracket{40.0, 45.0, 0.394, 0.476}, Bracket{35.0, 40.0, 0.275, 0.420},
    Bracket{30.0, 35.0, 0.260, 0.382}, Bracket{25.0, 30.0, 0.248, 0.287},
    Bracket{20.0, 25.0, 0.057, 0.065}, Bracket{10.0, 20.0, 0.048, 0.079},
};
inline constexpr double kPaperBestOverall_m = 0.244, kPaperMeanOverall_m = 0.372;

struct ErrorStatistics {
  std::uint64_t samples = 0;
  double sum_m = 0.0, max_m = 0.0;

  double mean_m() const { return samples == 0 ? kUnset : sum_m / static_cast<double>(samples); }
};

struct CrossTrack {
  std::array<ErrorStatistics, kBrackets.size()> by_bracket{};
  ErrorStatistics overall;  // above 10 m/s
  // Likewise; the first up to the start line.
  std::vector<ErrorStatistics> by_lap;
  std::uint64_t slow = 0;       // ticks below 10 m/s
  std::uint64_t undefined = 0;  // ticks with a NaN
};

void add(CrossTrack& statistics, double speed_mps, double cross_track_m,
         std::uint32_t laps_finished = 0);

std::string to_table(const CrossTrack& statistics);

}  // namespace pitwall::grading
