// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/path_deviation.hpp"

#include <algorithm>
#include <cmath>

#include "vehicle/world/mode.hpp"

namespace pitwall::bench {
namespace {

world::EgoState where(const plant::Truth& truth, Instant now) {
  world::EgoState ego;
  ego.at = now;
  ego.x_m = truth.x_m;
  ego.y_m = truth.y_m;
  ego.yaw_rad = truth.yaw_rad;
  ego.vx_mps = truth.vx_mps;
  ego.vy_mps = truth.vy_mps;
  ego.yaw_rate_rad_per_s = truth.yaw_rate_rad_per_s;
  ego.ax_mps2 = truth.specific_force_mps2[0];
  ego.ay_mps2 = truth.specific_force_mps2[1];
  ego.position_sigma_m = 0.0;
  ego.validity = world::Validity::kGood;
  return ego;
}

bool is(double mode, world::Mode wanted) { return mode == static_cast<double>(wanted); }

}  // namespace

void PathDeviation::plan(const plant::Truth& truth, Instant now) {
  const world::EgoState ego = where(truth, now);
  const world::RaceControl nobody;
  const planning::Output out =
      planning::step(setup_.params.planning, setup_.line, setup_.track, planner_,
                     {.ego = ego,
                      .race_control = nobody,
                      .followed = planning::Followed::kStop,
                      .tyre_c = *std::ranges::min_element(truth.tyre_c)},
                     now);
  planner_ = out.next;
  planned_at_ = now;
  off_m_ =
      std::abs(out.line_offset_m - planning::offset_at(planner_.stop, planner_.stop.gone_m).n_m);
}

double PathDeviation::off_path_m(const plant::Truth& truth, double cross_track_m, double mode,
                                 bool silent, Instant now) {
  const bool begins =
      silent || is(mode, world::Mode::kControlledStop) || is(mode, world::Mode::kEmergencyStop);
  if (!begins && (!stops_ || is(mode, world::Mode::kDriving))) {
    stops_ = false;
    return std::abs(cross_track_m);
  }
  if (!stops_) planner_ = {};
  if (!stops_ || now - planned_at_ >= kEvery) plan(truth, now);
  stops_ = true;
  return off_m_;
}

}  // namespace pitwall::bench
