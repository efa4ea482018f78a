// SPDX-License-Identifier: Apache-2.0
#include "tests/system/cars/car_stops.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>

#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/bench/signals.hpp"
#include "protocol/vocabulary/check.hpp"
#include "tests/hil/plant/family/grip_limit.hpp"
#include "tests/support/path_distance.hpp"
#include "vehicle/steering/road_load.hpp"

namespace pitwall::testing {
namespace {

using bench::Rig;

constexpr double kTick_s = 0.01, kEnd_s = 150.0, kStands_mps = 0.05;
constexpr double kTyre_c = 85.0, kMoves_mps = 15.0;
constexpr double kFastest_mps = 68.6;

const pipeline::Setup& setup_of(const std::string& track) {
  static std::map<std::string, pipeline::Setup> made;
  auto found = made.find(track);
  if (found == made.end()) {
    pipeline::Setup s = flying_lap(track).setup;
    s.params.planning.line.speed_max_mps = kFastest_mps;
    // The one that every car of the family can be driven by.
    s.params.control.controller = control::controller_named("feed_forward");
    auto line = planning::prepare(s.params.planning, s.track);
    CHECK(line);
    s.line = *std::move(line);
    found = made.emplace(track, std::move(s)).first;
  }
  return found->second;
}

scenario::Scenario scenario_of(const CarStopCase& stop) {
  scenario::Scenario s = green_run(stop.place.track, stop.plant, kTyre_c, to_mph(stop.speed_mps));
  s.duration = from_seconds(kEnd_s);
  s.start.s_m = stop.place.start_m;
  return s;
}

class Branches {
 public:
  Branches(const CarStopCase& stop, CarStopResults& results, const std::string& trace)
      : stop_(stop), setup_(setup_of(stop.place.track)), results_(results), trace_(trace) {}

  pipeline::Outputs step(pipeline::Car& car, const pipeline::Inputs& in) {
    const bool begins = !begun_at_ && is_at_place_;
    if (begins) branch(in.now);
    pipeline::Inputs now_in = in;
    if (begun_at_ && kind_ != CarStop::kGuardian) now_in.requests.arm = false;
    if (begun_at_ && kind_ == CarStop::kEmergency) now_in.requests.emergency_stop = true;
    world::SensorInput fewer = in.sensors;
    if (begun_at_) blind(fewer);
    const pipeline::Inputs blind_in{.now = now_in.now,
                                    .dt = now_in.dt,
                                    .can = now_in.can,
                                    .sensors = fewer,
                                    .requests = now_in.requests,
                                    .operator_inputs = now_in.operator_inputs,
                                    .gnss_byte_at = now_in.gnss_byte_at,
                                    .link = now_in.link,
                                    .radio_at = now_in.radio_at,
                                    .guardian = now_in.guardian};
    auto out = pipeline::step(setup_, car, blind_in);
    if (begins) planned_ = car.plan.output.stop;
    if (!begun_at_ || begins) refused_before_ = out.passed.refused_total;
    return out;
  }

  void watch(const pipeline::Outputs& out, const Rig& rig, Instant now) {
    const plant::Truth& t = rig.truth();
    const double use = plant::axle_use(stop_.plant, t);
    if (!begun_at_) {
      const double ahead_m = setup_.track.station_ahead(rig.road().s_m, stop_.place.station_m);
      is_at_place_ = t.speed_mps > kMoves_mps && ahead_m < 2.0 * t.speed_mps * kTick_s;
      use_before_ = use;
      from_mps_ = t.speed_mps;
      return;
    }
    CarStopFigures& f = figures_;
    if (f.stood || f.contact) return;
    if (!f.begun) f.begun = true, f.from_mps = from_mps_, f.use_before = use_before_;
    f.contact = rig.road().contact;
    f.wall_gap_m = std::min(f.wall_gap_m, bench::wall_gap_m(rig));
    f.distance_m += t.speed_mps * kTick_s;
    f.lasted_s = (now - *begun_at_).seconds();
    f.cross_track_m = std::max(f.cross_track_m, std::abs(path_distance_m(planned_, t.x_m, t.y_m)));
    f.refusals = static_cast<std::uint32_t>(out.passed.refused_total - refused_before_);
    if (t.speed_mps > kUseFrom_mps) {
      f.use = std::max(f.use, use);
      f.tyre_use = std::max(f.tyre_use, t.friction_use);
      f.slip_deg = std::max(f.slip_deg, std::abs(to_deg(std::atan2(t.vy_mps, t.vx_mps))));
    }
    note(out, rig, use);
    f.stood = t.speed_mps < kStands_mps;
  }

  bool car_is_dead() const { return begun_at_ && kind_ == CarStop::kGuardian; }
  bool over() const { return is_parent_of_all_ || figures_.stood || figures_.contact; }
  bool is_child() const { return is_child_; }
  void finish_child() {
    results_[static_cast<std::size_t>(kind_)] = figures_;
    if (trace_out_) std::fclose(trace_out_);
  }

 private:
  // The parent waits for each child in turn and ends its own run.
  void branch(Instant now) {
    for (const CarStop kind : kCarStops) {
      std::fflush(nullptr);
      const pid_t child = ::fork();
      CHECK(child >= 0);
      if (child == 0) {
        is_child_ = true, kind_ = kind, begun_at_ = now;
        if (!trace_.empty()) trace_out_ = std::fopen((trace_ + "." + text_of(kind)).c_str(), "w");
        return;
      }
      int status = 0;
      CHECK(::waitpid(child, &status, 0) == child);
      CHECK(status == 0);
    }
    is_parent_of_all_ = true;
  }

  void blind(world::SensorInput& sensors) const {
    if (kind_ == CarStop::kImus) sensors.imu.clear();
    if (kind_ != CarStop::kPositions) return;
    sensors.positions.clear(), sensors.velocities.clear();
    sensors.headings.clear(), sensors.attitudes.clear();
  }

  void note(const pipeline::Outputs& out, const Rig& rig, double use) {
    if (!trace_out_) return;
    const plant::Truth& t = rig.truth();
    std::fprintf(trace_out_,
                 "%.2f v %.2f e %.3f wheel %.4f cmd %.4f brake %.0f/%.0f throttle %.2f ay %.2f "
                 "ax %.2f use %.2f tyre %.2f slip %.2f r %.3f bank %.3f n %.2f s %.0f mode %d\n",
                 figures_.lasted_s, t.speed_mps, path_distance_m(planned_, t.x_m, t.y_m),
                 t.road_wheel_rad, out.chosen.command.road_wheel_rad, out.chosen.command.brake_kpa,
                 t.brake_front_kpa, t.throttle_fraction, t.specific_force_mps2[1],
                 t.specific_force_mps2[0], use, t.friction_use,
                 to_deg(std::atan2(t.vy_mps, t.vx_mps)), t.yaw_rate_rad_per_s, t.bank_rad,
                 rig.road().n_m, rig.road().s_m, static_cast<int>(out.chosen.mode));
  }

  const CarStopCase& stop_;
  const pipeline::Setup& setup_;
  CarStopResults& results_;
  std::string trace_;
  std::FILE* trace_out_ = nullptr;
  std::optional<Instant> begun_at_;
  bool is_at_place_ = false, is_child_ = false, is_parent_of_all_ = false;
  CarStop kind_ = CarStop::kControlled;
  double from_mps_ = kUnset, use_before_ = 0.0;
  std::uint64_t refused_before_ = 0;
  world::Trajectory planned_;
  CarStopFigures figures_;
};

}  // namespace

const char* text_of(CarStop stop) {
  constexpr std::array<const char*, kCarStops.size()> kTexts{"controlled", "emergency", "guardian",
                                                             "positions", "imus"};
  return kTexts[static_cast<std::size_t>(stop)];
}

const bench::Loaded& flying_lap(const std::string& track) {
  static std::map<std::string, bench::Loaded> loaded;
  auto found = loaded.find(track);
  if (found == loaded.end()) {
    const std::string root = PITWALL_SOURCE_DIR;
    auto read = bench::load(root + "/hil/scenarios/" + track + "_flying_lap.yaml", root);
    CHECK(read);
    found = loaded.emplace(track, *std::move(read)).first;
  }
  return found->second;
}

double speed_of(const plant::Params& plant, const std::string& track, double grip) {
  constexpr double kStep_m = 10.0, kStep_mps = 0.25, kSlowest_mps = 20.0;
  const world::TrackMap& map = setup_of(track).track;
  const auto is_carried = [&](double speed_mps) {
    for (double s_m = 0.0; s_m < map.length_m(); s_m += kStep_m) {
      const world::TrackPoint at = map.at(s_m);
      const double demand_mps2 =
          steering::lateral_demand_mps2({speed_mps, at.curvature_per_m, at.bank_rad});
      const plant::Turn turn{speed_mps, at.curvature_per_m, at.bank_rad};
      if (std::abs(demand_mps2) > kUseShare * plant::grip_limit(plant, turn, grip).lateral_mps2)
        return false;
    }
    return true;
  };
  double speed_mps = kFullSpeed_mps;
  while (speed_mps > kSlowest_mps && !is_carried(speed_mps)) speed_mps -= kStep_mps;
  return speed_mps;
}

std::string fault_of(const CarStopFigures& f) {
  std::string why;
  const auto add = [&](bool holds, const char* what) {
    if (holds) why += (why.empty() ? "" : ", ") + std::string(what);
  };
  add(!f.begun, "never got to the place");
  add(f.contact, "hits a wall");
  add(f.begun && !f.stood && !f.contact, "does not stand");
  add(f.slip_deg > kSpun_deg, "spins");
  add(f.use > kUseMost, "beyond its ellipse");
  return why;
}

void run_car_stops(const CarStopCase& stop, CarStopResults& results, const std::string& trace) {
  results = {};
  Branches run{stop, results, trace};
  bench::LockstepOptions options;
  options.guardian = true;
  options.step = [&](const pipeline::Setup&, pipeline::Car& car, const pipeline::Inputs& in) {
    return run.step(car, in);
  };
  options.watch = [&](const pipeline::Outputs& out, const Rig& rig, Instant now) {
    run.watch(out, rig, now);
  };
  options.car_is_dead = [&] { return run.car_is_dead(); };
  options.over = [&](const bench::RunView&) { return run.over(); };
  const auto result = bench::run_lockstep(scenario_of(stop), setup_of(stop.place.track), options);
  CHECK(result);
  if (!run.is_child()) return;
  run.finish_child();
  std::fflush(nullptr);
  ::_exit(0);
}

scenario::Scenario green_run(const std::string& track, const plant::Params& plant, double tyre_c,
                             double round_mph) {
  scenario::Scenario s = flying_lap(track).scenario;
  s.expect.clear();
  s.plant = plant;
  s.tyres.temperature_c = tyre_c;
  scenario::Fault held;
  held.kind = "cold_tyres";
  held.lasts = from_seconds(1e3);
  held.value = tyre_c;
  s.faults = {held};
  s.race_control = {
      {.at = milliseconds(500), .track = world::TrackFlag::kRed},
      {.at = seconds(4), .track = world::TrackFlag::kOrange},
      {.at = seconds(9), .track = world::TrackFlag::kYellow},
      {.at = seconds(10), .track = world::TrackFlag::kGreen, .round_target_speed_mph = round_mph}};
  return s;
}

}  // namespace pitwall::testing
