// Closed line by its offsets from a track's reference line at even stations: curvature and steps,
// with their derivatives by the offsets.
//   in     the track, the number of stations, offsets
//   out    curvature of the circle through three neighbours, distance to the next point
//   frames offset positive left, curvature positive left
//   cost   O(1) a station
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/raceline/lanes/lanes.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::raceline {

struct PlaneVector {
  double x = 0.0, y = 0.0;
};

// The curvature at a station, and the length that it stands for: half of both steps. Derivatives
// are by the offsets of the station before, this one and the one after.
struct Bend {
  double curvature_per_m = 0.0, length_m = 0.0;
  std::array<double, 3> curvature_by_offset{}, length_by_offset{};
};

// From a station to the next. Derivatives are by the offsets of both.
struct Step {
  double length_m = 0.0;
  std::array<double, 2> by_offset{};
};

class OffsetLine {
 public:
  OffsetLine(const world::TrackMap& track, std::size_t count);

  std::size_t size() const { return offset_m.size(); }
  Bend bend(std::size_t i) const;
  Step step(std::size_t i) const;

  std::vector<double> station_m, offset_m;

 private:
  PlaneVector place(std::size_t i) const;

  std::vector<PlaneVector> origin_, left_;
};

// What is free at every station, `margin_m` from the sides of the track; right of it is `low`.
struct OffsetBounds {
  std::vector<double> low_m, high_m;
};
Result<OffsetBounds, Problem> bounds_of(const OffsetLine& line, const Lanes& lanes,
                                        double margin_m);

// As many stations as leave at most `step_m` between two, and a multiple of `every`.
std::size_t stations_of(const world::TrackMap& track, double step_m, std::size_t every);

}  // namespace pitwall::raceline
