// Path-deviation monitor: distance of the car from the path that it has to hold. That is the line,
// and from the beginning of a stop the stop path, which the same planner plans here again from the
// true position of the car. A silent car has to stop too: its guardian stops it.
//   in     the true state; the mode that the car reports, once per tick
//   out    metres, not negative
//   invariants
//          the stop path stays in use until the car reports the mode driving
//   cost   nothing while the car drives; in a stop one planning step per kEvery
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/plant.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::bench {

class PathDeviation {
 public:
  explicit PathDeviation(const pipeline::Setup& setup) : setup_(setup) {}

  // `cross_track_m` from the line; `mode` as the car reports it, NaN before the first report.
  double off_path_m(const plant::Truth& truth, double cross_track_m, double mode, bool silent,
                    Instant now);

 private:
  static constexpr Duration kEvery = milliseconds(50);

  void plan(const plant::Truth& truth, Instant now);

  const pipeline::Setup& setup_;
  planning::State planner_;
  bool stops_ = false;
  Instant planned_at_{};
  double off_m_ = 0.0;
};

}  // namespace pitwall::bench
