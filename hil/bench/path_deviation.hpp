// Path-deviation monitor: distance of the car from the path that it has to hold: the line that it
// was told to drive, and from the beginning of a stop the path of that stop, planned here once more
// by the same planner from where the car truly is. A car that no longer speaks has to stop too: its
// guardian does.
//   in     the truth, the mode that the car says, once per tick
//   out    metres, not negative
//   invariants
//          the path of a stop stays until the car says that it drives
//   cost   nothing while the car drives; in a stop one plan in kEvery
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

  // `cross_track_m` from the line; `mode` as the car says it, unset before it has spoken.
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
