// Signals for the conditions of a scenario, by name, sampled once per tick. Signals of the car come
// from its outputs in lockstep and from its telemetry in the live bench; all others come from the
// true state of the bench. The monitors of the car are available in lockstep only: "seen_counter"
// and so on are 1 in each tick in which the monitor reports a fault.
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
#include "vehicle/world/track_map.hpp"

namespace pitwall::bench {

enum class Signal : std::uint8_t {
  kSpeed,
  kStation,
  kOffset,
  kAbsCrossTrack,  // true position against the line that the car has to drive
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
  kFlyingLapMean,  // best so far, 0 before the first
  kFramesLost,
  kMode,           // of the car's supervisor
  kGateRefusals,   // of the car's frame gate
  kBusRefusals,    // frames that the car did not apply
  kPositionError,  // of the car's localization against the truth
  kYawError,
  kSideSlip,        // angle between heading and motion, absolute, large in a spin; 0 below 5 m/s
  kIdentity,        // of the bus, as the car sees it: 0 listening, 1 right, 2 wrong
  kDifferingId,     // first CAN id that differs from the car's database; 0: none
  kActuatorFrames,  // commands to brake, accelerator, steering and gear on the bus
  kDeceleration,    // true, along the car; negative while it accelerates
  kStopCause,       // of the car: number of the first cause of the stop; 0: none
  kOperatorLimit,   // operator's speed limit that the car applies; 1000: none
  kRadioGap,        // time since the newest base datagram that reached the car was sent
  kRadioGapMax,     // longest radio gap of the run
  // 1: the car stopped for loss of its base, but the radio channel had no gap as long as the limit
  // of the car
  kRadioStopUnexplained,
  kOffPath,  // true position against the line, or in a stop against the stop path
  kFuel      // truly in the tank
};
inline constexpr std::size_t kSignals = 35;

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
                                                                     "off_path_m",
                                                                     "fuel_l"};

// Reported state of the car. Values are NaN before the first report, and conditions then see 0.
// silent: a car that reported before no longer does; its signals are NaN and meet no condition.
struct CarReport {
  double mode = kUnset, gate_refusals = kUnset, bus_refusals = kUnset;
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double identity = kUnset, differing_id = kUnset;
  double cause = kUnset, operator_limit_mps = kUnset;
  std::optional<world::MonitorSet> seen{};  // lockstep only
  bool silent = false;
  bool declines = false;  // live only: the attempt that it has to make
};

// The values of Signal, then one per monitor in the order of world::Monitor; NaN: not available.
using SignalValues = std::array<double, kSignals + world::kMonitors>;

struct SignalSources {
  const Rig& rig;
  const CarReport& car;
  double line_offset_m = 0.0;  // as line_offset_m() has it
  std::uint64_t frames_lost = 0;
  Duration radio_gap{}, radio_gap_max{};  // as the radio channel recorded it
  Duration radio_limit{};                 // the car stops after a longer gap
  double off_path_m = kUnset;             // from PathDeviation
};

// The radio gap after which the car stops, from its parameters.
Duration radio_limit_of(const pipeline::CarParams& params);

SignalValues observe(const SignalSources& from);
double cross_track_m(const Rig& rig, double line_offset_m);
double wall_gap_m(const Rig& rig);            // of the corner nearest to a wall, on either side
world::Curvilinear place_of(const Rig& rig);  // of the car, in truth
// Offset of the line from the track's reference line, beside a car at this place.
double line_offset_m(const pipeline::Setup& setup, const world::Curvilinear& car);
// True state of the car, as Outcome takes it.
VehiclePlace vehicle_place(const Rig& rig, double line_offset_m, Instant now);

std::vector<std::string> signal_names();

// Problem of the first expectation that this mode of the bench cannot evaluate.
std::optional<Problem> unjudged_by(BenchMode mode, const scenario::Scenario& scenario);

// The expectations of a scenario with their windows complete, for the grader.
Result<std::vector<grading::Expectation>, Problem> expectations_of(
    const scenario::Scenario& scenario);

}  // namespace pitwall::bench
