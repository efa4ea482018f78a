// Signals for the conditions of a scenario, by name, sampled once per tick. Signals of the car come
// from its outputs in lockstep and from its telemetry in the live bench; all others are the bench's
// own truth. The car's monitors are known in lockstep alone: "seen_counter" and so on are 1 in each
// tick in which the monitor reports a fault.
//   units  in the names; enumerations by their number
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hil/bench/fault_plan.hpp"
#include "hil/bench/outcome.hpp"
#include "hil/bench/rig.hpp"
#include "hil/grading/expectation.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/pipeline/setup.hpp"
#include "vehicle/world/monitor.hpp"

namespace pitwall::bench {

enum class Signal : std::uint8_t {
  kSpeed,
  kStation,
  kOffset,
  kAbsCrossTrack,  // truth against the line that the car was told to drive
  kWallGap,
  kContact,
  kFrictionUse,
  kLateralForce,
  kBrake,
  kThrottle,
  kSteering,
  kGear,
  kSysState,
  kCtState,
  kTrackFlag,
  kLaps,
  kFlyingLapMean,  // best so far, 0 until there is one
  kFramesLost,
  kMode,           // of the car's supervisor
  kGateRefusals,   // of the car's frame gate
  kBusRefusals,    // frames that the car did not apply
  kPositionError,  // of the car's localization against the truth
  kYawError,
  kSideSlip,     // size of the angle between heading and motion; a spin is seen here. 0 below 5 m/s
  kIdentity,     // of the bus, as the car sees it: 0 listening, 1 right, 2 wrong
  kDifferingId,  // the first CAN id that is not as in the car's database; 0: none
  kActuatorFrames,  // commands to brake, accelerator, steering and gear that were on the bus
  kDeceleration,    // of the truth along the car; negative while it speeds up
  kStopCause,       // of the car: what stopped it first, by its number; 0: nothing
  kOperatorLimit,   // that the car heeds of its operator; 1000 where there is none
  kRadioGap,        // since the newest datagram of the base that reached the car was sent
  kRadioGapMax,     // the longest of the run
  // 1: the car stopped for its base station, but the air has no gap as long as the car's limit
  kRadioStopUnexplained,
  kOffPath  // truth against the path that holds: the line, and in a stop the path of the stop
};
inline constexpr std::size_t kSignals = 34;

inline constexpr std::array<std::string_view, kSignals> kSignalNames{"speed_mps",
                                                                     "station_m",
                                                                     "offset_m",
                                                                     "abs_cross_track_m",
                                                                     "wall_gap_m",
                                                                     "contact",
                                                                     "friction_use",
                                                                     "lateral_force_mps2",
                                                                     "brake_kpa",
                                                                     "throttle",
                                                                     "steering_motor_deg",
                                                                     "gear",
                                                                     "sys_state",
                                                                     "ct_state",
                                                                     "track_flag",
                                                                     "laps",
                                                                     "flying_lap_mean_mps",
                                                                     "frames_lost",
                                                                     "mode",
                                                                     "gate_refusals",
                                                                     "bus_refusals",
                                                                     "position_error_m",
                                                                     "yaw_error_rad",
                                                                     "side_slip_deg",
                                                                     "identity",
                                                                     "differing_id",
                                                                     "actuator_frames",
                                                                     "deceleration_mps2",
                                                                     "stop_cause",
                                                                     "operator_limit_mps",
                                                                     "radio_gap_s",
                                                                     "radio_gap_max_s",
                                                                     "radio_stop_unexplained",
                                                                     "off_path_m"};

// What the car says of itself. Unset until it has said something; silent: it has spoken before and
// no longer does, so nothing is known, which meets no condition.
struct CarReport {
  double mode = kUnset, gate_refusals = kUnset, bus_refusals = kUnset;
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double identity = kUnset, differing_id = kUnset;
  double cause = kUnset, operator_limit_mps = kUnset;
  std::optional<world::MonitorSet> seen{};  // in lockstep
  bool silent = false;
};

// Those of Signal, then one per monitor in the order of world::Monitor; NaN: not known here.
using SignalValues = std::array<double, kSignals + world::kMonitors>;

struct SignalSources {
  const Rig& rig;
  const CarReport& car;
  double line_offset_m = 0.0;  // of the line from the track's reference line
  std::uint64_t frames_lost = 0;
  Duration radio_gap{}, radio_gap_max{};  // by the air's own record
  Duration radio_limit{};                 // of the car: it stops after a longer gap
  double off_path_m = kUnset;             // PathDeviation
};

// The gap after which the car stops, as its file has it.
Duration radio_limit_of(const pipeline::CarParams& params);

SignalValues observe(const SignalSources& from);
double cross_track_m(const Rig& rig, double line_offset_m);
double wall_gap_m(const Rig& rig);  // of the nearest corner, on either side
// What an Outcome is made of.
Whereabouts whereabouts(const Rig& rig, double line_offset_m, Instant now);

std::vector<std::string> signal_names();

// The first expectation that this kind of bench cannot judge.
std::optional<Problem> unjudged_by(BenchMode mode, const scenario::Scenario& scenario);

// The expectations of a scenario as the grader takes them.
Result<std::vector<grading::Expectation>, Problem> expectations_of(
    const scenario::Scenario& scenario);

}  // namespace pitwall::bench
