// Fault detection: every cause that holds in this tick, each with the value that exceeded its
// limit. A pure function whose state holds only what durations and counts need.
//   in     signals, bus health, flags, ego state, watchdog rows, verdicts of planning and control,
//          last commands to the actuators, the computer's health
//   out    set of causes; causes.hpp gives the reaction to each, mode_table.hpp the mode that
//          follows
//   invariants
//          a monitor that is switched off has no findings
//   errors none
//
// Dead bus. The drive-by-wire sends four messages every 10 ms or faster, without pauses. When no
// message from it arrives for bus_dead (0.07 s), the bus is dead; one lost message is not enough.
// With ticks of 10 ms and telemetry at 50 Hz the base reports it 0.1 s after the last frame. There
// is no feedback from the actuators, but they may still receive commands: the car brakes as in any
// emergency. A stop from top speed takes less than bus_dead_disarm (20 s: 80 m/s at 4 m/s^2, which
// the safe stop demands without a plan). If the bus is dead for longer, no actuator follows
// commands, and the car disarms by itself. To move again it needs a live bus and a new arm request
//   false alarms: seven frames of each of four messages in a row would have to be lost
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/safety/clock_watch.hpp"
#include "vehicle/safety/computer_judge.hpp"
#include "vehicle/safety/fault_log.hpp"
#include "vehicle/safety/following.hpp"
#include "vehicle/safety/oversteer.hpp"
#include "vehicle/safety/watchdog.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/health.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/monitor.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/sensor_input.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::safety {

// Limits for the actuators, from the lags in [T] and [O] of the plant's sources (steering 0.1 s,
// brake 0.1 s, throttle 0.05 s) plus the delay on the bus.
struct ActuatorParams {
  FollowLimits steering{.settle_s = 0.2, .tolerance = 0.05};                // rad at the motor
  FollowLimits brake{.settle_s = 0.25, .tolerance = 200.0, .share = 0.05};  // kPa
  FollowLimits throttle{.settle_s = 0.15, .tolerance = 0.06};               // 0 .. 1
  // Largest innovation of the learned steering, beyond one standard deviation; road wheel. It may
  // last for steering.persist. [0.002, 0.05]
  double unexplained_max_rad = 0.008;
  // Below it the drive-by-wire may hold the car itself; [1, 20].
  double moving_mps = 3.0;
};

struct FaultParams {
  Duration dead_reckoning_max = milliseconds(1500);
  Duration dead_reckoning_coast = milliseconds(300);  // [0.05 s, dead_reckoning_max)
  Duration bus_dead = milliseconds(70);    // no message of the drive-by-wire; [0.03, 0.1] s
  Duration bus_dead_disarm = seconds(20);  // after the bus is dead
  double position_sigma_max_m = 1.0;       // fused position
  double gnss_sigma_max_m = 0.5;           // as the receivers report it
  std::uint8_t control_failures = 3;       // consecutive ticks; [1, 20]
  std::uint8_t refused_ticks = 3;          // consecutive ticks; [1, 20]
  bool radio_loss_stops = true;            // when the watchdog row "radio" is bad
  bool race_control_required = true;
  ActuatorParams following;
  OversteerParams oversteer;
  ClockParams clock;
  ComputerParams computer;
  world::MonitorSet off{};  // set by the bench only, not by a car file
};

inline constexpr auto kFaultRanges = std::to_array<world::NamedRange<FaultParams>>({
    {"gnss_sigma_max_m", &FaultParams::gnss_sigma_max_m, 0.05, 10.0},
    {"position_sigma_max_m", &FaultParams::position_sigma_max_m, 0.1, 10.0},
});

inline constexpr auto kFaultTimes = std::to_array<world::NamedTime<FaultParams>>({
    {"dead_reckoning_max_s", &FaultParams::dead_reckoning_max, 0.1, 10.0},
    {"dead_reckoning_coast_s", &FaultParams::dead_reckoning_coast, 0.05, 10.0},
    {"bus_dead_disarm_s", &FaultParams::bus_dead_disarm, 5.0, 60.0},
});

// Requests of the operator, as levels. `stop` and `emergency_stop` act while they are set, and the
// mode keeps their effect; `reset` acts on its rising edge.
struct OperatorRequests {
  bool arm = false, reset = false, stop = false, emergency_stop = false;
};

struct FaultInputs {
  const world::VehicleSignals& signals;
  const world::BusHealth& bus;
  const world::RaceControl& race_control;
  const world::EgoState& ego;
  const WatchdogOutput& watchdog;
  OperatorRequests operator_requests;
  bool radio_stop = false;    // LinkLossOutput
  bool own_id_seen = false;   // gateway::InboundOutput
  bool bus_failed = false;    // BusGuardOutput
  bool control_ok = false;    // control gave a command in this tick
  bool gate_refused = false;  // the gate refused a frame of the previous tick
  bool driving = false;       // control is expected to give commands
  bool moves = false;         // mode in which the car may roll: driving, coasting, stopping
  bool radio_fades = false;   // link-loss policy is beyond its first step
  bool engine_off = false;    // the drive-by-wire is commanded to shut down
  const world::SensorInput* sensors = nullptr;  // null: clocks are not monitored
  world::ComputerHealth computer{};
  // Last command to the actuators; unset before the first.
  world::ActuatorCommand reported{};
  double steering_ratio = 19.5;
  double wheelbase_m = kUnset;
  double lock_slip = kUnset;  // a front wheel that slips more is locking
  // Of steering::Learned in this tick; unset while nothing is learned.
  double innovation_rad = kUnset, innovation_sigma_rad = kUnset;
  double speed_mps = kUnset;  // from the wheels
};

// Yaw rates of the two IMUs against each other.
struct YawRateWatch {
  std::array<double, world::kGnssUnits> rate_rad_per_s{kUnset, kUnset};
  std::array<Instant, world::kGnssUnits> at{};
  double apart_rad_per_s = 0.0;  // of unit 0 less unit 1, smoothed
  Instant judged{};
};

struct FaultState {
  bool positioned = false;  // ego state has been good
  Instant last_good{};      // time of the last good ego state
  std::uint8_t control_failed_ticks = 0, gate_refused_ticks = 0;
  bool bus_dead = false;
  Instant bus_dead_since{};  // time of detection
  FollowState steering, brake_front, brake_rear, throttle;
  Instant last_explained{};  // last time that the car turned as its steering sensor reports
  YawRateWatch yaw_rates;
  OversteerState oversteer;
  FrontWheelState front_wheels;
  ClockState clock;
  ComputerState computer;
};

struct FaultOutput {
  CauseSet causes;
  std::array<double, kCauses> values{};  // of each cause that holds
  bool drive_by_wire_gone = false;       // the bus has been dead for bus_dead_disarm
  bool steering_biased = false;          // the car does not turn as its steering sensor reports
  bool oversteers = false;
  double front_slip = kUnset;  // oversteer.hpp
  world::MonitorSet seen{};    // monitors with a finding in this tick
};

FaultOutput detect(const FaultParams& params, FaultState& state, const FaultInputs& inputs,
                   Instant now);

// Speed from the wheels: mean of the two middle ones of four, so that one wheel that locks, spins
// or has a wrong sensor has no effect. Unset if older than `limit` or if a wheel is not a number.
inline constexpr Duration kWheelAgeMax = milliseconds(250);  // for supervision
double wheel_speed_mps(const world::VehicleSignals& signals, Instant now, Duration limit);

}  // namespace pitwall::safety
