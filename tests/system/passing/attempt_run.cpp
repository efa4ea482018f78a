// SPDX-License-Identifier: Apache-2.0
#include "tests/system/passing/attempt_run.hpp"

#include <algorithm>
#include <cmath>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/sensors/detection_params.hpp"
#include "protocol/rules/attempt.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/random.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/support/reversals.hpp"

namespace pitwall::testing {
namespace {

constexpr const char* kTree = PITWALL_SOURCE_DIR;
constexpr double kOwnStart_m = 2200.0;

const char* car_of(Driver driver) {
  return driver == Driver::kOurs ? "vehicle/config/cars/av21_race.yaml"
                                 : "tests/system/passing/published.yaml";
}

// Follows one run from outside.
class Watch {
 public:
  pipeline::Outputs step(const pipeline::Setup& setup, pipeline::Car& car,
                         const pipeline::Inputs& in) {
    const pipeline::Outputs out = pipeline::step(setup, car, in);
    const planning::Output& plan = car.plan.output;
    note(plan.next.pass.phase);
    const world::RaceControl& rc = car.plan.made_with;
    const bool waved =
        rc.track == world::TrackFlag::kWavingGreen && rc.vehicle == world::VehicleFlag::kAttacker;
    const double pass_mps = plan.next.pass.pass_mps;
    if (waved) reversals_.take(std::isfinite(pass_mps) ? pass_mps : rc.round_target_speed_mps);
    return out;
  }

  void fill(AttemptRun& run) const {
    run.passes = passes_, run.flaps = flaps_;
    run.reversals = reversals_.count();
  }

 private:
  void note(PassPhase phase) {
    if (phase == phase_) return;
    if (!is_allowed(phase_, phase)) ++flaps_;
    if (phase == PassPhase::kPass) ++passes_;
    phase_ = phase;
  }

  PassPhase phase_ = PassPhase::kFree;
  std::size_t passes_ = 0, flaps_ = 0;
  Reversals reversals_;
};

Verdict verdict_of(rules::Ending ending, std::size_t passes) {
  switch (ending) {
    case rules::Ending::kPassed:
      return Verdict::kPassed;
    case rules::Ending::kContactByAttacker:
    case rules::Ending::kContactByDefender:
    case rules::Ending::kContactShared:
      return Verdict::kContact;
    default:
      return passes == 0 ? Verdict::kDeclined : Verdict::kLost;
  }
}

// The first attempt that counts, or that a contact ended.
const race::AttemptRecord* counted(const race::MatchSheet& sheet) {
  const auto at = std::ranges::find_if(sheet.attempts, [](const race::AttemptRecord& record) {
    return record.score != rules::Score::kRepeated;
  });
  return at == sheet.attempts.end() ? nullptr : &*at;
}

std::string faults_of(SensorsOut out) {
  if (out == SensorsOut::kNone) return {};
  if (out == SensorsOut::kFrontLidar)
    return "faults:\n  - {kind: lidar_outage, at_s: 0, unit: 0}\n";
  std::string rows = "faults:\n";
  for (std::size_t unit = 0; unit < sensors::kCameraUnits; ++unit)
    rows += formatted("  - {kind: camera_outage, at_s: 0, unit: %zu}\n", unit);
  return rows;
}

}  // namespace

const char* text_of(Driver driver) { return driver == Driver::kOurs ? "ours" : "paper"; }

const char* text_of(SensorsOut out) {
  constexpr std::array kNames{"all sensors", "cameras out", "front LiDAR out"};
  return kNames[static_cast<std::size_t>(out)];
}

const char* text_of(Verdict verdict) {
  constexpr std::array kNames{"passed", "declined", "lost", "contact"};
  return kNames[static_cast<std::size_t>(verdict)];
}

bool is_allowed(PassPhase from, PassPhase to) {
  return std::ranges::find(kAllowed, std::pair{from, to}) != kAllowed.end();
}

AttemptDraw drawn(std::uint64_t seed) {
  Random random{mix_bits(seed)};
  AttemptDraw draw;
  draw.start_gap_m = random.between(40.0, 240.0);
  draw.speed_sigma_mps = random.between(0.3, 0.6);
  draw.speed_correlation_s = random.between(5.0, 20.0);
  draw.lane_sigma_m = random.between(0.1, 0.3);
  draw.lane_correlation_s = random.between(6.0, 15.0);
  draw.friction = random.between(0.95, 1.05);
  draw.detection_noise = random.between(0.8, 1.25);
  return draw;
}

std::string scenario_text(const AttemptCase& attempt) {
  const AttemptDraw draw = drawn(attempt.seed);
  const char* const cameras =
      attempt.cameras == scenario::CameraKind::kRendered ? "rendered" : "model";
  return formatted(R"(schema: 1
name: attempt_%.0f_%llu_%s
seed: %llu
duration_s: 400
track: vehicle/config/tracks/tms.yaml
car: %s
lidars: %s
cameras: %s
start: {s_m: %.0f, n_m: 0, speed_mps: 0}
tyres: {temperature_c: 85}
perturb: {friction: %.4f, detection_noise: %.4f}
race_control:
  - {at_s: 0.5, track: red}
  - {at_s: 4, track: orange}
  - {at_s: 9, track: yellow, round_target_speed_mph: 60}
  - {at_s: 14, track: green, round_target_speed_mph: 80}
cars:
  - name: rival
    number: 2
    kind: ghost
    start: {s_m: %.1f, speed_mps: 25}
    offset_m: -5
    speed: {mps: 25}
    drift: {sigma_m: %.3f, correlation_s: %.2f, most_m: 0.6}
    speed_drift: {sigma_mps: %.3f, correlation_s: %.2f, most_mps: 1.5}
match:
  rival: rival
  begins_s: 25
  first: own
  brackets_mph: [%.0f]
  lanes: {inside_m: 0, outside_m: -5}
  attempts: [decline]
  defends: [hold]
%s)",
                   attempt.round_mph, static_cast<unsigned long long>(attempt.seed),
                   text_of(attempt.driver), static_cast<unsigned long long>(attempt.seed),
                   car_of(attempt.driver), name_of(attempt.lidars), cameras, kOwnStart_m,
                   draw.friction, draw.detection_noise, kOwnStart_m - draw.start_gap_m,
                   draw.lane_sigma_m, draw.lane_correlation_s, draw.speed_sigma_mps,
                   draw.speed_correlation_s, attempt.round_mph, faults_of(attempt.out).c_str());
}

AttemptRun run_attempt(const AttemptCase& attempt) {
  AttemptRun run{.of = attempt};
  const auto folder = transport::TemporaryFolder::create("pitwall-attempt-");
  if (!folder) return run.problem = to_string(folder.error()), run;
  const std::string file = folder->path() + "/attempt.yaml";
  if (const auto written = transport::write_file(file, scenario_text(attempt)); !written)
    return run.problem = to_string(written.error()), run;
  const auto loaded = bench::load(file, kTree);
  if (!loaded) return run.problem = to_string(loaded.error()), run;
  Watch watch;
  bench::LockstepOptions options;
  options.step = [&](const pipeline::Setup& setup, pipeline::Car& car, const pipeline::Inputs& in) {
    return watch.step(setup, car, in);
  };
  const auto result = bench::run_lockstep(*loaded, options);
  if (!result) return run.problem = to_string(result.error()), run;
  const race::AttemptRecord* record = counted(*result->match);
  if (record == nullptr) return run.problem = "no attempt was judged", run;
  watch.fill(run);
  run.ending = rules::name_of(record->ending);
  run.laps = record->laps_used;
  run.verdict = verdict_of(record->ending, run.passes);
  if (result->car_contact) run.verdict = Verdict::kContact;
  run.refusals = result->gate_refusals;
  return run;
}

}  // namespace pitwall::testing
