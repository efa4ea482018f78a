// Attempt of our car, drawn by a seed, to pass a ghost that defends the inside lane: in lockstep,
// with estimator and tracker in the loop.
//   in     AttemptCase: seed, round speed, who drives; what varies is drawn from the seed alone
//   out    AttemptRun: how it ended, the states of the pass on the way, how the speed was commanded
//   draws  start gap 40 to 240 m, wander of the defender's speed 0.3 to 0.6 m/s rms and of its lane
//          0.1 to 0.3 m rms, friction 0.95 to 1.05 of nominal, noise of the seen cars 0.8 to 1.25
//   invariants
//          a scenario file written from scenario_text() shows the same attempt
//   source hysteresis and flaps: pass.hpp, whose list of transitions is kAllowed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/planning/pass.hpp"

namespace pitwall::testing {

// kPaper: the same car with the published tracker and planner.
enum class Driver : std::uint8_t { kOurs, kPaper };
inline constexpr std::array kDrivers{Driver::kOurs, Driver::kPaper};
const char* text_of(Driver driver);

// What is out from the start on, of all sensors that see other cars.
enum class SensorsOut : std::uint8_t { kNone, kCameras, kFrontLidar };
const char* text_of(SensorsOut out);

struct AttemptCase {
  std::uint64_t seed = 0;
  double round_mph = kUnset;
  Driver driver = Driver::kOurs;
  scenario::LidarKind lidars = scenario::LidarKind::kModel;
  scenario::CameraKind cameras = scenario::CameraKind::kModel;
  SensorsOut out = SensorsOut::kNone;
};

struct AttemptDraw {
  double start_gap_m = kUnset;
  double speed_sigma_mps = kUnset, speed_correlation_s = kUnset;
  double lane_sigma_m = kUnset, lane_correlation_s = kUnset;
  double friction = kUnset;
  double detection_noise = kUnset;
};
AttemptDraw drawn(std::uint64_t seed);

// Of the attempt, for a file; car files are named from the root of the tree.
std::string scenario_text(const AttemptCase& attempt);

using planning::PassPhase;
inline constexpr std::array kAllowed{
    std::pair{PassPhase::kFree, PassPhase::kTrail},  std::pair{PassPhase::kTrail, PassPhase::kFree},
    std::pair{PassPhase::kTrail, PassPhase::kPass},  std::pair{PassPhase::kPass, PassPhase::kAhead},
    std::pair{PassPhase::kPass, PassPhase::kYield},  std::pair{PassPhase::kAhead, PassPhase::kFree},
    std::pair{PassPhase::kAhead, PassPhase::kYield}, std::pair{PassPhase::kYield, PassPhase::kFree},
    std::pair{PassPhase::kYield, PassPhase::kTrail}};
bool is_allowed(PassPhase from, PassPhase to);

// kDeclined: no pass was begun. kLost: one was, and it was not made in two laps; or a breach.
enum class Verdict : std::uint8_t { kPassed, kDeclined, kLost, kContact };
const char* text_of(Verdict verdict);

struct AttemptRun {
  AttemptCase of;
  Verdict verdict = Verdict::kLost;
  std::string ending{};       // as the judge names it
  double laps = kUnset;       // from waving green to the gap of 30 m, or to the end
  std::size_t passes = 0;     // begun
  std::size_t flaps = 0;      // transitions that are not among kAllowed
  std::size_t reversals = 0;  // of the wanted speed by more than 1 m/s, under waving green
  std::size_t refusals = 0;   // of the frame gate
  std::string problem{};      // the run was not made
};

AttemptRun run_attempt(const AttemptCase& attempt);

}  // namespace pitwall::testing
