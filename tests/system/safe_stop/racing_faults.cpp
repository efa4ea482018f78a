// SPDX-License-Identifier: Apache-2.0
#include "tests/system/safe_stop/racing_faults.hpp"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <vector>

#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/bench/signals.hpp"
#include "protocol/vocabulary/check.hpp"
#include "tests/system/cars/car_stops.hpp"
#include "tests/system/safe_stop/impact_bound.hpp"

namespace pitwall::testing {
namespace {

using bench::Rig;
using faults::BenchFault;
using faults::BenchFaultKind;

constexpr double kTickOfCar_s = 0.01, kLongestRun_s = 200.0, kStoodBelow_mps = 0.05,
                 kWarmTyres_c = 85.0;
constexpr double kStart_m = 1250.0, kMoves_mps = 15.0, kSlipAbove_mps = 5.0;
constexpr double kStopAfter_s = 1.0;  // the operator's
constexpr double kDrags_kpa = 1500.0, kWorthless = 1000.0;

scenario::Scenario lead_in(const plant::Params& plant) {
  scenario::Scenario s = flying_lap("lvms").scenario;
  s.duration = from_seconds(kLongestRun_s);
  s.expect.clear();
  s.plant = plant;
  s.start.s_m = kStart_m;
  s.tyres.temperature_c = kWarmTyres_c;
  s.race_control = {{.at = milliseconds(500), .track = world::TrackFlag::kRed},
                    {.at = seconds(4), .track = world::TrackFlag::kOrange},
                    {.at = seconds(9), .track = world::TrackFlag::kYellow},
                    {.at = seconds(10),
                     .track = world::TrackFlag::kGreen,
                     .round_target_speed_mph = to_mph(kRacing_mps)}};
  return s;
}

std::vector<BenchFault> faults_of(RacingFault fault) {
  switch (fault) {
    case RacingFault::kSteeringSlow:
      return {{.kind = BenchFaultKind::kSteeringSlow, .value = kSlowMotor_rad_per_s}};
    case RacingFault::kThrottleStuck:
      return {{.kind = BenchFaultKind::kThrottleStuck}};
    case RacingFault::kBrakeFree:
      return {{.kind = BenchFaultKind::kBrakeStuck, .value = 0.0}};
    case RacingFault::kBrakeDrags:
      return {{.kind = BenchFaultKind::kBrakeStuck, .value = kDrags_kpa}};
    case RacingFault::kFrontBrakeLost:
      return {{.kind = BenchFaultKind::kBrakeCircuitLost, .unit = 0}};
    case RacingFault::kRearBrakeLost:
      return {{.kind = BenchFaultKind::kBrakeCircuitLost, .unit = 1}};
    case RacingFault::kPositions:
      return {{.kind = BenchFaultKind::kGnssVarianceSpike, .unit = 0, .value = kWorthless},
              {.kind = BenchFaultKind::kGnssVarianceSpike, .unit = 1, .value = kWorthless}};
    case RacingFault::kImus:
      return {{.kind = BenchFaultKind::kImuOutage, .unit = 0},
              {.kind = BenchFaultKind::kImuOutage, .unit = 1}};
    case RacingFault::kSteeringStuck:
      return {{.kind = BenchFaultKind::kSteeringStuck}};
    case RacingFault::kReference:
      return {{.kind = BenchFaultKind::kGnssUnitOutage, .unit = 0},
              {.kind = BenchFaultKind::kGnssUnitOutage, .unit = 1}};
    case RacingFault::kComputer:
      break;
  }
  return {};
}

// Those that the car is not told of by anything until it has to stop.
bool is_latent(RacingFault fault) {
  return fault == RacingFault::kSteeringSlow || fault == RacingFault::kThrottleStuck ||
         fault == RacingFault::kBrakeFree || fault == RacingFault::kFrontBrakeLost ||
         fault == RacingFault::kRearBrakeLost;
}

class Branches {
 public:
  explicit Branches(RacingResults& results) : results_(results) {}

  pipeline::Outputs step(const pipeline::Setup& setup, pipeline::Car& car, pipeline::Inputs in) {
    if (!begun_at_ && is_at_place_) branch(in.now);
    const bool stops =
        begun_at_ && is_latent(fault_) && in.now - *begun_at_ >= from_seconds(kStopAfter_s);
    if (stops) in.requests.arm = false;
    return pipeline::step(setup, car, in);
  }

  void break_rig(Rig& rig, Instant now) {
    if (!begun_at_ || broken_) return;
    broken_ = true;
    for (BenchFault fault : faults_of(fault_)) {
      fault.start = now;
      rig.add_fault(fault);
    }
  }

  void watch(const Rig& rig, Instant now, const world::TrackMap& track) {
    const plant::Truth& t = rig.truth();
    if (!begun_at_) {
      const double ahead_m = track.station_ahead(rig.road().s_m, kRacingTurn_m);
      is_at_place_ = t.speed_mps > kMoves_mps && ahead_m < 2.0 * t.speed_mps * kTickOfCar_s;
      return;
    }
    RacingFigures& f = figures_;
    if (f.stood || f.contact) return;
    if (!f.begun) f.begun = true, f.from_mps = t.speed_mps;
    f.lasted_s = (now - *begun_at_).seconds();
    f.distance_m += t.speed_mps * kTickOfCar_s;
    f.wall_gap_m = std::min(f.wall_gap_m, bench::wall_gap_m(rig));
    f.end_mps = t.speed_mps;
    if (t.speed_mps > kSlipAbove_mps)
      f.slip_deg = std::max(f.slip_deg, std::abs(to_deg(std::atan2(t.vy_mps, t.vx_mps))));
    f.contact = rig.road().contact;
    f.stood = t.speed_mps < kStoodBelow_mps;
    if (!f.contact) return;
    f.impact_mps = t.speed_mps;
    f.normal_mps = normal_mps(track, rig.road(), t.speed_mps, std::atan2(t.vy_mps, t.vx_mps));
  }

  bool car_is_dead() const { return begun_at_ && fault_ == RacingFault::kComputer; }
  bool over() const { return is_parent_of_all_ || figures_.stood || figures_.contact; }
  bool is_child() const { return is_child_; }
  void finish_child() { results_[static_cast<std::size_t>(fault_)] = figures_; }

 private:
  // The parent waits for each child in turn and ends its own run.
  void branch(Instant now) {
    for (std::size_t i = 0; i < kRacingFaults; ++i) {
      std::fflush(nullptr);
      const pid_t child = ::fork();
      CHECK(child >= 0);
      if (child == 0) {
        is_child_ = true, fault_ = static_cast<RacingFault>(i), begun_at_ = now;
        return;
      }
      int status = 0;
      CHECK(::waitpid(child, &status, 0) == child);
      CHECK(status == 0);
    }
    is_parent_of_all_ = true;
  }

  RacingResults& results_;
  std::optional<Instant> begun_at_;
  bool is_at_place_ = false, is_child_ = false, is_parent_of_all_ = false, broken_ = false;
  RacingFault fault_ = RacingFault::kSteeringSlow;
  RacingFigures figures_;
};

}  // namespace

const char* text_of(RacingFault fault) {
  constexpr std::array<const char*, kRacingFaults> kTexts{
      "steering slow",    "throttle stuck",  "brake free",        "brake drags",
      "front brake lost", "rear brake lost", "no positions",      "no IMU",
      "steering stuck",   "no reference",    "car, guardian dead"};
  return kTexts[static_cast<std::size_t>(fault)];
}

RacingResults race_into_faults(const plant::Params& plant) {
  void* const at = ::mmap(nullptr, sizeof(RacingResults), PROT_READ | PROT_WRITE,
                          MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  CHECK(at != MAP_FAILED);
  RacingResults& shared = *new (at) RacingResults{};
  Branches run{shared};
  const pipeline::Setup& setup = flying_lap("lvms").setup;
  bench::LockstepOptions options;
  options.step = [&](const pipeline::Setup& own, pipeline::Car& car, const pipeline::Inputs& in) {
    return run.step(own, car, in);
  };
  options.watch = [&](const pipeline::Outputs&, const Rig& rig, Instant now) {
    run.watch(rig, now, setup.track);
  };
  options.break_rig = [&](Rig& rig, Instant now) { run.break_rig(rig, now); };
  options.car_is_dead = [&] { return run.car_is_dead(); };
  options.over = [&](const bench::RunView&) { return run.over(); };
  const auto result = bench::run_lockstep(lead_in(plant), setup, options);
  CHECK(result);
  if (run.is_child()) {
    run.finish_child();
    std::fflush(nullptr);
    ::_exit(0);
  }
  const RacingResults results = shared;
  ::munmap(at, sizeof(RacingResults));
  return results;
}

std::string row_of(RacingFault fault, const RacingFigures& f) {
  std::array<char, 240> text{};
  std::snprintf(text.data(), text.size(),
                "%-18s from %4.1f m/s: %s after %5.1f s, %4.0f m, at %4.1f m/s; wall %5.2f m, slip "
                "%4.1f deg, impact %4.1f m/s, normal %4.1f m/s",
                text_of(fault), f.from_mps,
                f.stood     ? "stands"
                : f.contact ? "HITS A WALL"
                            : "rolls",
                f.lasted_s, f.distance_m, f.end_mps, f.wall_gap_m, f.slip_deg, f.impact_mps,
                f.normal_mps);
  return text.data();
}

}  // namespace pitwall::testing
