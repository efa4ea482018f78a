// SPDX-License-Identifier: Apache-2.0
#include "tests/system/localization/scored_run.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "hil/bench/loading.hpp"

namespace pitwall::bench {
namespace {

using localization::Estimate;
using localization::FilterKind;

constexpr double kRoundSpeed_mph = 153.0;  // beyond the 68 m/s of the car's line

Loaded loaded() {
  const std::string root = PITWALL_SOURCE_DIR;
  auto read = load(root + "/hil/scenarios/lvms_flying_lap.yaml", root);
  if (!read) ADD_FAILURE() << to_string(read.error());
  return *std::move(read);
}

// The flying lap without what is asked of it, green until the end.
scenario::Scenario scenario_of(const scenario::Scenario& lap, const RunPlan& plan) {
  scenario::Scenario s = lap;
  s.name = "localization";
  s.seed = plan.seed;
  s.duration = from_seconds(plan.until_s);
  s.faults = plan.faults;
  s.expect.clear();
  while (!s.race_control.empty() && s.race_control.back().track == world::TrackFlag::kRed &&
         s.race_control.size() > 1)
    s.race_control.pop_back();
  for (scenario::FlagChange& change : s.race_control)
    if (change.track == world::TrackFlag::kGreen) change.round_target_speed_mph = kRoundSpeed_mph;
  return s;
}

double nees_of(const Estimate& e, const Eigen::Vector<double, 5>& error) {
  const Eigen::Map<const Eigen::Matrix<double, 5, 5, Eigen::RowMajor>> covariance(
      e.covariance.data());
  return error.dot(covariance.ldlt().solve(error));
}

Tick tick_of(const world::EgoState& ego, const Estimate& estimate, const plant::Truth& truth,
             Instant now) {
  Tick t{.at_s = (now - Instant{}).seconds(),
         .truth_speed_mps = truth.speed_mps,
         .bank_rad = truth.bank_rad};
  t.estimated = std::isfinite(ego.x_m) && std::isfinite(ego.yaw_rad) && std::isfinite(ego.vx_mps);
  if (!t.estimated) return t;
  t.east_m = ego.x_m - truth.x_m, t.north_m = ego.y_m - truth.y_m, t.up_m = ego.z_m - truth.z_m;
  t.yaw_rad = wrap_pi(ego.yaw_rad - truth.yaw_rad);
  t.roll_rad = ego.roll_rad - truth.roll_rad, t.pitch_rad = ego.pitch_rad - truth.pitch_rad;
  t.speed_mps = ego.vx_mps - truth.vx_mps, t.left_mps = ego.vy_mps - truth.vy_mps;
  t.position_sigma_m = ego.position_sigma_m;
  t.nees = nees_of(estimate, {t.east_m, t.north_m, t.yaw_rad, t.speed_mps, t.left_mps});
  return t;
}

// The planar filter beside the car: the same samples, signals and road.
class Shadow {
 public:
  explicit Shadow(const pipeline::Setup& setup) : params_(setup.params.localization) {
    params_.filter.kind = FilterKind::kPlanar;
  }
  void step(const pipeline::Setup& setup, const pipeline::Inputs& in,
            const world::VehicleSignals& signals, const localization::Surroundings& road,
            world::SensorUse use) {
    out_ = localization::step(params_, setup.datum, state_, in.sensors, signals, road, use, in.now);
  }
  const localization::Output& out() const { return out_; }

 private:
  localization::Params params_;
  localization::State state_;
  localization::Output out_;
};

}  // namespace

double Tick::position_m() const { return std::hypot(east_m, north_m); }

ScoredRun run_scored(const RunPlan& plan) {
  static const Loaded lap = loaded();
  pipeline::Setup setup = lap.setup;
  setup.params.localization.filter.kind = FilterKind::kSpatial;
  setup.params.localization.off = plan.off;
  if (plan.vectornav) setup.params.receivers[1].kind = world::ReceiverKind::kVectorNav;
  const auto shadow = std::make_unique<Shadow>(setup);
  ScoredRun run;
  LockstepOptions options;
  options.step = [&](const pipeline::Setup& s, pipeline::Car& car, const pipeline::Inputs& in) {
    const localization::Surroundings road = car.surroundings;
    pipeline::Outputs out = pipeline::step(s, car, in);
    shadow->step(s, in, out.received.signals, road, car.orders.use);
    return out;
  };
  options.watch = [&](const pipeline::Outputs& out, const Rig& rig, Instant now) {
    run.spatial.push_back(tick_of(out.ego, out.estimate, rig.truth(), now));
    run.planar.push_back(tick_of(shadow->out().ego, shadow->out().estimate, rig.truth(), now));
  };
  const scenario::Scenario scenario = scenario_of(lap.scenario, plan);
  auto result = run_lockstep(scenario, setup, options);
  if (!result) {
    ADD_FAILURE() << to_string(result.error());
    return run;
  }
  run.result = *std::move(result);
  return run;
}

Errors errors_of(const std::vector<Tick>& ticks, double from_s, double until_s) {
  Errors e;
  const Tick* before = nullptr;
  for (const Tick& t : ticks) {
    if (t.at_s < from_s || t.at_s > until_s) continue;
    if (!t.estimated) {
      ++e.without;
      continue;
    }
    ++e.ticks;
    e.position_rms_m += t.position_m() * t.position_m();
    e.heading_rms_rad += t.yaw_rad * t.yaw_rad;
    e.speed_rms_mps += t.speed_mps * t.speed_mps;
    e.height_rms_m += t.up_m * t.up_m;
    e.position_max_m = std::max(e.position_max_m, t.position_m());
    e.speed_mean_mps += t.truth_speed_mps;
    e.nees_mean += t.nees;
    if (before != nullptr)
      e.jump_max_m = std::max(e.jump_max_m,
                              std::hypot(t.east_m - before->east_m, t.north_m - before->north_m));
    before = &t;
  }
  const auto n = static_cast<double>(e.ticks);
  for (double* square : {&e.position_rms_m, &e.heading_rms_rad, &e.speed_rms_mps, &e.height_rms_m})
    *square = std::sqrt(*square / n);
  e.speed_mean_mps /= n, e.nees_mean /= n;
  return e;
}

void print_header() {
  std::printf("%-34s %-8s %6s %9s %9s %9s %9s %9s %9s %7s\n", "", "filter", "m/s", "pos rms m",
              "pos max m", "head deg", "speed m/s", "height m", "jump m", "NEES/5");
}

void print_row(const std::string& what, const char* filter, const Errors& e) {
  std::printf("%-34s %-8s %6.1f %9.4f %9.4f %9.4f %9.4f %9.4f %9.4f %7.2f%s\n", what.c_str(),
              filter, e.speed_mean_mps, e.position_rms_m, e.position_max_m,
              to_deg(e.heading_rms_rad), e.speed_rms_mps, e.height_rms_m, e.jump_max_m,
              e.nees_mean / 5.0, e.without > 0 ? "  (partly without estimate)" : "");
}

void print_both(const std::string& what, const ScoredRun& run, double from_s, double until_s) {
  print_row(what, "spatial", errors_of(run.spatial, from_s, until_s));
  print_row(what, "planar", errors_of(run.planar, from_s, until_s));
}

std::uint64_t seeds(std::uint64_t quick) {
  const char* const wanted = std::getenv("PITWALL_LOCALIZATION_SEEDS");
  return wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : quick;
}

scenario::Fault fault(const char* kind, std::uint32_t unit, double at_s, double for_s,
                      double value) {
  return {.kind = kind,
          .at = from_seconds(at_s),
          .lasts = from_seconds(for_s),
          .unit = unit,
          .value = value,
          .place = "test"};
}

}  // namespace pitwall::bench
