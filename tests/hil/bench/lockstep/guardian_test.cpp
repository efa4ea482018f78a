// The guardian in the lockstep bench: the car's process is killed, or stopped for a while, at speed
// on Las Vegas Motor Speedway.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/bench/signals.hpp"
#include "tests/hil/bench/flying_lap.hpp"
#include "vehicle/autonomy/control/preview.hpp"

namespace pitwall::bench {
namespace {

constexpr double kFlying_s = 62.0;  // the first flying lap has begun

scenario::Scenario scenario_with(std::vector<scenario::Fault> faults, double duration_s) {
  scenario::Scenario s = lap().scenario;
  s.duration = from_seconds(duration_s);
  s.faults = std::move(faults);
  s.expect.clear();
  return s;
}

scenario::Fault fault(const std::string& kind, double at_s, double lasts_s = 1e3) {
  scenario::Fault f;
  f.kind = kind;
  f.at = from_seconds(at_s);
  f.lasts = from_seconds(lasts_s);
  return f;
}

// What became of the car from the first tick of the guardian on.
struct Stop {
  double from_s = kUnset, from_mps = kUnset, station_m = kUnset;
  double stood_s = kUnset, distance_m = 0.0;
  double off_line_m = 0.0, off_path_m = 0.0, wall_gap_m = 1e9, decel_mps2 = 0.0, jerk_mps3 = 0.0,
         friction = 0.0;
  guardian::Guidance guidance = guardian::Guidance::kNone;
  guardian::Mode mode = guardian::Mode::kIdle;
  std::uint64_t gate_refusals = 0;
  double slowest_mps = 1e9, contact_mps = 0.0;  // speed at the first contact with a wall
};

class Observer {
 public:
  explicit Observer(double from_s) : from_(Instant{} + from_seconds(from_s)) {}

  LockstepOptions options() {
    LockstepOptions o;
    o.step = [this](const pipeline::Setup& setup, pipeline::Car& car, const pipeline::Inputs& in) {
      const pipeline::Outputs out = pipeline::step(setup, car, in);
      if (!guardian::drives(stop.mode)) path_ = car.plan.output.stop;
      return out;
    };
    o.watch = [this](const pipeline::Outputs&, const Rig& rig, Instant now) { see(rig, now); };
    o.watch_guardian = [this](const GuardianNode& node, Instant) {
      stop.mode = node.status().mode;
      if (node.status().mode == guardian::Mode::kDriving) stop.guidance = node.status().guidance;
      stop.gate_refusals = std::max(stop.gate_refusals, node.gate_refusals());
    };
    return o;
  }
  Stop stop;

 private:
  void see(const Rig& rig, Instant now) {
    const plant::Truth& truth = rig.truth();
    if (now < from_) return;
    if (std::isnan(stop.from_s)) {
      stop.from_s = (now - Instant{}).seconds();
      stop.from_mps = truth.speed_mps;
      stop.station_m = rig.road().s_m;
    }
    if (rig.road().contact || stop.contact_mps > 0.0) {  // what follows means nothing
      stop.contact_mps = std::max(stop.contact_mps, truth.speed_mps);
      return;
    }
    stop.slowest_mps = std::min(stop.slowest_mps, truth.speed_mps);
    stop.distance_m += truth.speed_mps * 0.01;
    const double off_m = cross_track_m(rig, lap().setup.params.planning.line.offset_m);
    stop.off_line_m = std::max(stop.off_line_m, std::abs(off_m));
    stop.off_path_m = std::max(stop.off_path_m, std::abs(off_path_m(truth)));
    stop.wall_gap_m = std::min(stop.wall_gap_m,
                               std::min(rig.road().wall_gap_left_m, rig.road().wall_gap_right_m));
    stop.friction = std::max(stop.friction, truth.friction_use);
    smooth_.push_back(truth.speed_mps);
    const std::size_t n = smooth_.size();
    if (n > 20) {  // over 0.1 s
      const double a = (smooth_[n - 1] - smooth_[n - 11]) / 0.1;
      const double before = (smooth_[n - 11] - smooth_[n - 21]) / 0.1;
      stop.decel_mps2 = std::max(stop.decel_mps2, -a);
      if (truth.speed_mps > 2.0)
        stop.jerk_mps3 = std::max(stop.jerk_mps3, std::abs(a - before) / 0.1);
    }
    if (truth.speed_mps < 0.3 && std::isnan(stop.stood_s)) stop.stood_s = (now - from_).seconds();
    if (truth.speed_mps > 0.5) stop.stood_s = kUnset;
  }

  // From the stop that was ready last: it leaves the line for the low side of the banking.
  double off_path_m(const plant::Truth& truth) const {
    const auto s_m = control::project(path_, truth.x_m, truth.y_m);
    if (!s_m) return 0.0;
    const world::TrajectoryPoint at = control::at(path_, *s_m);
    return (truth.y_m - at.y_m) * std::cos(at.yaw_rad) -
           (truth.x_m - at.x_m) * std::sin(at.yaw_rad);
  }

  Instant from_;
  std::vector<double> smooth_;
  world::Trajectory path_;
};

RunResult run(const scenario::Scenario& s, const LockstepOptions& options) {
  auto result = run_lockstep(s, lap().setup, options);
  if (!result) ADD_FAILURE() << to_string(result.error());
  return *std::move(result);
}

void print(const char* name, const Stop& s) {
  std::printf(
      "%s: at s = %4.0f m, %4.1f m/s: stands after %4.1f s, %3.0f m; off its path %.2f m, "
      "wall gap %.2f m, decel %.1f m/s2, jerk %.0f m/s3, friction %.2f, %s\n",
      name, s.station_m, s.from_mps, s.stood_s, s.distance_m, s.off_path_m, s.wall_gap_m,
      s.decel_mps2, s.jerk_mps3, s.friction, guardian::text_of(s.guidance));
}

TEST(Guardian, StopsTheCarOnTheTrackWhereverItsProcessIsKilled) {
  constexpr int kPlaces = 4;
  constexpr double kLap_s = 37.0;
  for (int i = 0; i < kPlaces; ++i) {
    const double at_s = kFlying_s + kLap_s * i / kPlaces;
    Observer observer{at_s};
    run(scenario_with({fault("computer_killed", at_s)}, at_s + 30.0), observer.options());
    const Stop& stop = observer.stop;
    print("killed", stop);
    EXPECT_GT(stop.from_mps, 60.0);
    EXPECT_LT(stop.stood_s, 25.0);
    EXPECT_GT(stop.wall_gap_m, 0.5);
    EXPECT_LT(stop.off_path_m, 1.0);
    EXPECT_LT(stop.decel_mps2, 8.0);
    EXPECT_LT(stop.friction, 1.0);
    EXPECT_EQ(stop.mode, guardian::Mode::kHalted);
    EXPECT_EQ(stop.gate_refusals, 0u);
  }
}

TEST(Guardian, ACarThatWasStoppedForAMomentDrivesOnAlongItsLine) {
  for (const double at_s : {62.0, 71.5}) {
    Observer observer{at_s};
    LockstepOptions options = observer.options();
    std::uint32_t hand_backs = 0;
    options.watch_guardian = [&, see = options.watch_guardian](const GuardianNode& n, Instant now) {
      see(n, now);
      hand_backs = n.status().hand_backs;
    };
    const RunResult result =
        run(scenario_with({fault("computer_paused", at_s, 0.2)}, at_s + 45.0), options);
    print("paused", observer.stop);
    std::printf("  slowest %.1f m/s, laps %u\n", observer.stop.slowest_mps, result.laps.finished);
    EXPECT_EQ(hand_backs, 1u);
    EXPECT_EQ(observer.stop.mode, guardian::Mode::kWatching);
    EXPECT_LT(observer.stop.off_line_m, 1.0);
    EXPECT_GT(observer.stop.slowest_mps, 60.0);
    EXPECT_GE(result.laps.finished, 2u);
    EXPECT_EQ(result.gate_refusals, 0u);
    EXPECT_EQ(observer.stop.gate_refusals, 0u);
  }
}

TEST(Guardian, WithBothKilledTheDriveByWireActsByItsOwnRule) {
  for (const double at_s : {62.0, 71.5}) {
    Observer observer{at_s};
    bool rule = true;
    double held_rad = kUnset;
    LockstepOptions options = observer.options();
    options.watch = [&, see = options.watch](const pipeline::Outputs& o, const Rig& rig,
                                             Instant now) {
      see(o, rig, now);
      const double since_s = (now - Instant{}).seconds() - at_s;
      const plant::Truth& truth = rig.truth();
      if (since_s > 0.5 && std::isnan(held_rad)) held_rad = truth.steering_motor_rad;
      if (since_s < 1.5 || truth.speed_mps < 1.0 || rig.road().contact) return;
      rule = rule && truth.throttle_fraction < 0.01 && truth.brake_front_kpa > 1700.0 &&
             std::abs(truth.steering_motor_rad - held_rad) < 0.01;
    };
    run(scenario_with({fault("computer_killed", at_s), fault("guardian_killed", at_s)},
                      at_s + 30.0),
        options);
    print("both killed", observer.stop);
    std::printf("  %s\n",
                observer.stop.contact_mps > 0.0 ? "hits the wall" : "does not hit a wall");
    EXPECT_TRUE(rule);
  }
}

// How far it gets with less: nothing is promised without any receiver but that it brakes.
TEST(Guardian, WithFewerReceiversItStillStops) {
  struct Less {
    const char* what;
    std::vector<scenario::Fault> faults;
    double off_path_max_m;
  };
  const auto unit = [](scenario::Fault f, std::uint32_t n, double value = kUnset) {
    f.unit = n;
    f.value = value;
    return f;
  };
  for (const double at_s : {62.0}) {
    const auto both = [&](const char* kind, double value = kUnset) {
      return std::vector{unit(fault(kind, at_s), 0, value), unit(fault(kind, at_s), 1, value)};
    };
    const Less cases[]{
        {"no positions", both("gnss_variance_spike", 1000.0), 2.5},
        {"no gyroscopes", both("imu_outage"), 2.5},
        {"no receivers", both("gnss_unit_outage"), 1e3},
        {"one unit jumps", {unit(fault("gnss_position_jump", at_s), 0, 20.0)}, 1.0},
    };
    for (const Less& less : cases) {
      std::vector<scenario::Fault> faults = less.faults;
      faults.push_back(fault("computer_killed", at_s));
      Observer observer{at_s};
      run(scenario_with(faults, at_s + 30.0), observer.options());
      print(less.what, observer.stop);
      EXPECT_LT(observer.stop.off_path_m, less.off_path_max_m) << less.what;
      EXPECT_EQ(observer.stop.gate_refusals, 0u) << less.what;
      if (less.off_path_max_m > 100.0) continue;
      EXPECT_EQ(observer.stop.contact_mps, 0.0) << less.what;
      EXPECT_EQ(observer.stop.mode, guardian::Mode::kHalted) << less.what;
    }
  }
}

// A guardian that is not needed changes no byte of a run, whatever else goes wrong.
TEST(Guardian, IsSilentWhereTheCarsProcessLives) {
  for (const char* name : {"bus_silent", "launch_and_stop"}) {
    auto loaded = load(kRoot + "/hil/scenarios/" + name + ".yaml", kRoot);
    ASSERT_TRUE(loaded) << name;
    std::string digests[2];
    std::uint32_t takeovers = 0;
    for (const bool guarded : {false, true}) {
      LockstepOptions options;
      options.log = nowhere();
      options.guardian = guarded;
      options.watch_guardian = [&](const GuardianNode& n, Instant) {
        takeovers = std::max(takeovers, n.status().takeovers);
      };
      auto result = run_lockstep(loaded->scenario, loaded->setup, options);
      ASSERT_TRUE(result) << name;
      digests[guarded ? 1 : 0] = result->digest;
    }
    EXPECT_FALSE(digests[0].empty());
    EXPECT_EQ(digests[0], digests[1]) << name;
    EXPECT_EQ(takeovers, 0u) << name;
  }
}

// Killed for three seconds: the new process is not armed, and leaves the bus to the guardian until
// the car stands.
TEST(Guardian, AProcessThatIsStartedAnewMeanwhileStaysQuietAndDisarmed) {
  constexpr double kAt_s = 62.0;
  Observer observer{kAt_s};
  LockstepOptions options = observer.options();
  bool spoke = false, armed = false;
  options.watch = [&, see = options.watch](const pipeline::Outputs& out, const Rig& rig,
                                           Instant now) {
    see(out, rig, now);
    if (now < Instant{} + from_seconds(kAt_s + 3.0)) return;
    armed |= out.chosen.actuate;
    spoke |= rig.truth().speed_mps > 0.5 && !out.passed.frames.empty();
  };
  run(scenario_with({fault("computer_killed", kAt_s, 3.0)}, kAt_s + 30.0), options);
  print("killed and started anew", observer.stop);
  EXPECT_FALSE(spoke);
  EXPECT_FALSE(armed);
  EXPECT_LT(observer.stop.off_path_m, 1.0) << "the path leaves the line for the low side";
  EXPECT_LT(observer.stop.stood_s, 25.0);
  EXPECT_FALSE(guardian::drives(observer.stop.mode)) << "a start that is not armed ends the hold";
}

}  // namespace
}  // namespace pitwall::bench
