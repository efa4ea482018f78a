// SPDX-License-Identifier: Apache-2.0
#include "tests/system/safe_stop/stop_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/bench/signals.hpp"
#include "tests/support/path_distance.hpp"

namespace pitwall::testing {
namespace {

using bench::Loaded;
using bench::Rig;

// From rest to the place: where the road is nearly level, 1.5 km and more before it.
constexpr double kFrontStretch_m = 2250.0, kBackStretch_m = 1250.0, kFirstEnd_m = 1100.0;
constexpr double kEnd_s = 110.0;
constexpr double kBreaks_s = 4.0;   // after the begin of the stop
constexpr double kFrontLeft = 0.5;  // of the front brakes' torque, where they are weak
constexpr double kTick_s = 0.01;
constexpr std::size_t kSmooth = 20;  // ticks: 0.2 s
constexpr double kStands_mps = 0.05, kSlipFrom_mps = 5.0, kTurnedFrom_deg = 10.0;

const Loaded& lap() {
  static const Loaded loaded = [] {
    const std::string root = PITWALL_SOURCE_DIR;
    auto read = bench::load(root + "/hil/scenarios/lvms_flying_lap.yaml", root);
    if (!read) ADD_FAILURE() << to_string(read.error());
    return *std::move(read);
  }();
  return loaded;
}

// The car of the project, allowed a little more than 68 m/s so that it holds them.
const pipeline::Setup& setup() {
  static const pipeline::Setup made = [] {
    pipeline::Setup s = lap().setup;
    s.params.planning.line.speed_max_mps = 68.6;
    auto line = planning::prepare(s.params.planning, s.track);
    if (!line) ADD_FAILURE() << to_string(line.error());
    s.line = *std::move(line);
    return s;
  }();
  return made;
}

// As if nobody had thought of banking: all brake there is, at once.
const pipeline::Setup& harsh_setup() {
  static const pipeline::Setup made = [] {
    pipeline::Setup s = setup();
    planning::Params& p = s.params.planning;
    p.stop_decel_max_mps2 = 100.0, p.stop_jerk_max_mps3 = 1000.0, p.stop_grip_share = 100.0;
    p.line.friction.brake_max_mps2 = 100.0;
    s.params.supervisor.safe_stop.brake_ramp_kpa_per_s = 20000.0;
    s.params.supervisor.safe_stop.decel_max_mps2 = 100.0;
    s.params.supervisor.safe_stop.brake_max_kpa = 8000.0;
    s.params.supervisor.safe_stop.grip_share = 100.0;
    s.params.control.longitudinal.brake_max_kpa = 8000.0;
    s.params.supervisor.safe_stop.friction = 100.0, s.params.supervisor.safe_stop.brake_share = 1.0;
    s.params.gate.brake_max_kpa = 8191.0;
    for (auto& row : s.params.gate.stop_brake) row.kpa = 8191.0;
    return s;
  }();
  return made;
}

const pipeline::Setup& without_control() {
  static const pipeline::Setup made = [] {
    pipeline::Setup s = setup();
    s.params.control.lateral.angle_max_rad = kUnset;
    return s;
  }();
  return made;
}

scenario::Scenario scenario_of(const StopCase& stop) {
  scenario::Scenario s = lap().scenario;
  s.duration = from_seconds(kEnd_s);
  s.expect.clear();
  s.start.s_m = stop.station_m < kFirstEnd_m ? kBackStretch_m : kFrontStretch_m;
  s.tyres.temperature_c = stop.tyre_c;
  s.plant.thermal.cold_grip_loss = kColdLoss;
  if (stop.breakage == Breakage::kFrontBrakes || stop.breakage == Breakage::kFullRearBrake)
    s.plant.brakes.front_remaining = kFrontLeft;
  scenario::Fault held;  // at their temperature, whatever warms or cools them
  held.kind = "cold_tyres";
  held.lasts = from_seconds(1e3);
  held.value = stop.tyre_c;
  s.faults = {held};
  s.race_control = {{.at = milliseconds(500), .track = world::TrackFlag::kRed},
                    {.at = seconds(4), .track = world::TrackFlag::kOrange},
                    {.at = seconds(9), .track = world::TrackFlag::kYellow},
                    {.at = seconds(10),
                     .track = world::TrackFlag::kGreen,
                     .round_target_speed_mph = to_mph(68.6)}};
  return s;
}

class StopRun {
 public:
  explicit StopRun(const StopCase& stop) : stop_(stop) {}

  pipeline::Outputs step(const pipeline::Setup& own, pipeline::Car& car,
                         const pipeline::Inputs& in) {
    const bool due = !begun_at_ && is_at_place_;
    if (due) begun_at_ = in.now;
    pipeline::Inputs now_in = in;
    if (begun_at_) now_in.requests.arm = false;
    if (begun_at_ && stop_.emergency) now_in.requests.emergency_stop = true;
    const double since_s = begun_at_ ? (in.now - *begun_at_).seconds() : -1.0;
    if (since_s > 0.0 && breaks(Breakage::kPlanning)) car.plan.at = in.now;
    world::SensorInput fewer;
    if (since_s > kBreaks_s && stop_.breakage == Breakage::kPositions) fewer.imu = in.sensors.imu;
    const bool blind = since_s > kBreaks_s && (stop_.breakage == Breakage::kPositions ||
                                               stop_.breakage == Breakage::kSensors);
    const pipeline::Inputs blind_in{.now = now_in.now,
                                    .dt = now_in.dt,
                                    .can = now_in.can,
                                    .sensors = fewer,
                                    .requests = now_in.requests,
                                    .operator_inputs = now_in.operator_inputs,
                                    .link = now_in.link,
                                    .radio_at = now_in.radio_at,
                                    .guardian = now_in.guardian};
    const auto out =
        pipeline::step(since_s > 0.0 ? broken(own) : setup(), car, blind ? blind_in : now_in);
    if (due) figures.planned = car.plan.output.stop;
    return out;
  }

  void watch(const pipeline::Outputs& out, const Rig& rig, Instant now) {
    const plant::Truth& t = rig.truth();
    const double ahead_m = setup().track.station_ahead(rig.road().s_m, stop_.station_m);
    is_at_place_ = is_at_place_ || (t.speed_mps > 50.0 && ahead_m < t.speed_mps * kTick_s);
    accel_.push_back(t.specific_force_mps2[0]);
    use_.push_back(t.friction_use);
    if (!begun_at_ || figures.contact) return;
    if (!figures.begun) begin(rig);
    figures.begun = true;
    if (figures.stood) return;
    figures.contact = rig.road().contact;
    figures.wall_gap_m = std::min(figures.wall_gap_m, bench::wall_gap_m(rig));
    figures.distance_m += t.speed_mps * kTick_s;
    figures.lasted_s = (now - *begun_at_).seconds();
    figures.cross_track_m =
        std::max(figures.cross_track_m, std::abs(path_distance_m(figures.planned, t.x_m, t.y_m)));
    figures.use = std::max(figures.use, t.friction_use);
    watch_wheels(t);
    judge_jerk(out);
    if (t.speed_mps < kStands_mps && !figures.stood) end(rig);
  }

  StopFigures figures;

 private:
  bool breaks(Breakage what) const {
    return stop_.breakage == what || stop_.breakage == Breakage::kPlanningAndControl;
  }
  const pipeline::Setup& broken(const pipeline::Setup&) const {
    if (stop_.breakage == Breakage::kFullBrake || stop_.breakage == Breakage::kFullRearBrake)
      return harsh_setup();
    return breaks(Breakage::kControl) ? without_control() : setup();
  }

  void begin(const Rig& rig) {
    figures.from_mps = rig.truth().speed_mps;
    figures.from_bank_deg = to_deg(rig.truth().bank_rad);
    const std::size_t second = std::min<std::size_t>(use_.size(), 100);
    figures.use_before = *std::max_element(use_.end() - static_cast<long>(second), use_.end());
  }

  void watch_wheels(const plant::Truth& t) {
    if (t.speed_mps < kSlipFrom_mps) return;
    figures.slip_deg = std::max(figures.slip_deg, std::abs(to_deg(std::atan2(t.vy_mps, t.vx_mps))));
    const auto stands = [&](std::size_t i) { return t.wheel_speed_mps[i] < kStands_mps; };
    if (figures.slip_deg > kTurnedFrom_deg) return;  // what locks in a spin is no cause of it
    figures.front_locked = figures.front_locked || (stands(0) && stands(1));
    figures.rear_locked = figures.rear_locked || (stands(2) && stands(3));
  }

  void end(const Rig& rig) {
    figures.stood = true;
    figures.end_s_m = rig.road().s_m;
    figures.end_n_m = rig.road().n_m;
    figures.end_bank_deg = to_deg(rig.truth().bank_rad);
  }

  double mean_accel(std::size_t end) const {
    double sum = 0.0;
    for (std::size_t i = end - kSmooth; i < end; ++i) sum += accel_[i];
    return sum / static_cast<double>(kSmooth);
  }

  void judge_jerk(const pipeline::Outputs&) {
    const std::size_t n = accel_.size();
    if (n < 2 * kSmooth) return;
    const double now = mean_accel(n), before = mean_accel(n - kSmooth);
    const double span_s = static_cast<double>(kSmooth) * kTick_s;
    figures.jerk_mps3 = std::max(figures.jerk_mps3, std::abs(now - before) / span_s);
    figures.decel_mps2 = std::max(figures.decel_mps2, -now);
  }

  StopCase stop_;
  std::optional<Instant> begun_at_;
  bool is_at_place_ = false;
  std::vector<double> accel_, use_;
};

// Of the plan, over time: the change of its acceleration from point to point.
double jerk_of(const world::Trajectory& plan) {
  double largest = 0.0;
  for (std::size_t i = 1; i < plan.points.size(); ++i) {
    const auto &a = plan.points[i - 1], &b = plan.points[i];
    const double mean_mps = 0.5 * (a.speed_mps + b.speed_mps);
    if (b.speed_mps < 1.0) break;
    largest = std::max(largest, std::abs(b.accel_mps2 - a.accel_mps2) * mean_mps / (b.s_m - a.s_m));
  }
  return largest;
}

}  // namespace

const char* text_of(Breakage breakage) {
  constexpr std::array<const char*, 9> kTexts{
      "nothing broken", "full brake",   "weak front brakes",      "full brake, weak front brakes",
      "planning dead",  "control dead", "planning, control dead", "no positions",
      "no receivers"};
  return kTexts[static_cast<std::size_t>(breakage)];
}

StopFigures run_stop(const StopCase& stop) {
  StopRun run{stop};
  bench::LockstepOptions options;
  options.step = [&](const pipeline::Setup& own, pipeline::Car& car, const pipeline::Inputs& in) {
    return run.step(own, car, in);
  };
  options.watch = [&](const pipeline::Outputs& out, const Rig& rig, Instant now) {
    run.watch(out, rig, now);
  };
  options.over = [&](const bench::RunView&) { return run.figures.stood || run.figures.contact; };
  const auto result = bench::run_lockstep(scenario_of(stop), setup(), options);
  if (!result) ADD_FAILURE() << to_string(result.error());
  run.figures.planned_jerk_mps3 = jerk_of(run.figures.planned);
  return run.figures;
}

std::string row_of(const StopCase& stop, const StopFigures& f) {
  std::array<char, 320> text{};
  std::snprintf(
      text.data(), text.size(),
      "s %4.0f m, bank %4.1f, %2.0f C, %s%s: from %4.1f m/s (use %.2f) %s after %4.1f s, %3.0f m, "
      "at "
      "s %4.0f n %4.1f bank %4.1f; cross-track %.2f m, use %.2f, jerk %4.1f (plan %4.1f) m/s3, "
      "decel %.1f m/s2, slip %.1f deg, wall %.2f m%s%s%s",
      stop.station_m, f.from_bank_deg, stop.tyre_c, text_of(stop.breakage),
      stop.emergency ? ", emergency" : "", f.from_mps, f.use_before,
      f.stood ? "stands" : "DOES NOT STAND", f.lasted_s, f.distance_m, f.end_s_m, f.end_n_m,
      f.end_bank_deg, f.cross_track_m, f.use, f.jerk_mps3, f.planned_jerk_mps3, f.decel_mps2,
      f.slip_deg, f.wall_gap_m, f.front_locked ? ", front locked" : "",
      f.rear_locked ? ", rear locked" : "", f.contact ? ", HITS A WALL" : "");
  return text.data();
}

}  // namespace pitwall::testing
