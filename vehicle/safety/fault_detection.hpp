// Fault detection: every cause that holds in this tick, each with the number that crossed its
// limit. Pure; latches nothing but the instants that "too long" needs.
//   in     signals, bus health, flags, ego state, watchdog rows, verdicts of planning and control,
//          what the actuators were told, the computer's health
//   out    a set of causes; causes.hpp says what is done about each, mode_table what follows
//   invariants
//          what a monitor finds that is switched off is not found
//   errors none
//
// The dead bus. The drive-by-wire sends four messages every 10 ms or faster and never pauses. When
// nothing of it was heard for bus_dead (0.07 s), the bus is dead: no single message can tell, and
// none need be waited for. With ticks of 10 ms and telemetry at 50 Hz the base knows 0.1 s after
// the last frame. Nobody says what the actuators do, but they may still hear: the car brakes as in
// any emergency. A stop from top speed takes less than bus_dead_disarm (20 s: 80 m/s at 4 m/s^2,
// which the safe stop demands without a plan); a bus dead for so long means that nobody obeys, and
// the car disarms by itself. Moving again needs a bus, and arming anew
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
#include "vehicle/world/bus_health.hpp"
#include "vehicle/world/computer_health.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/monitor.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/sensor_input.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::safety {

// Of the actuators as localization and the drive-by-wire know them: the lags of [T] and [O] of the
// plant's sources, 0.1 s of steering, 0.1 s of brake, 0.05 s of throttle, and the way on the bus.
struct ActuatorParams {
  FollowLimits steering{.settle_s = 0.2, .tolerance = 0.05};                // rad at the motor
  FollowLimits brake{.settle_s = 0.25, .tolerance = 200.0, .share = 0.05};  // kPa
  FollowLimits throttle{.settle_s = 0.15, .tolerance = 0.06};               // 0 .. 1
  double moving_mps = 3.0;  // below, the drive-by-wire may hold the car itself; [1, 20]
};

struct FaultParams {
  Duration dead_reckoning_max = milliseconds(1500);
  Duration dead_reckoning_coast = milliseconds(300);  // [0.05 s, dead_reckoning_max)
  Duration bus_dead = milliseconds(70);               // nothing of the drive-by-wire; [0.03, 0.1] s
  Duration bus_dead_disarm = seconds(20);             // thereafter
  double position_sigma_max_m = 1.0;                  // of the fused position
  double gnss_sigma_max_m = 0.5;                      // of both units' own
  std::uint8_t control_failures = 3;                  // ticks in a row; [1, 20]
  std::uint8_t refused_ticks = 3;  // ticks in a row with a refused frame; [1, 20]
  bool radio_loss_stops = true;    // base station lost for the watchdog's limit
  bool race_control_required = true;
  ActuatorParams following;
  OversteerParams oversteer;
  ClockParams clock;
  ComputerParams computer;
  world::MonitorSet off{};  // of the bench alone: no car file sets it
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

// What the operator asks, as levels. `stop` and `emergency_stop` act while they are held and their
// effect stays by the modes; `reset` acts on its rising edge.
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
  bool control_ok = false;    // control gave a command this tick
  bool gate_refused = false;  // the gate refused a frame of the previous tick
  bool driving = false;       // control is expected to give commands
  bool moves = false;         // a mode in which the car may roll: driving, coasting, stopping
  bool radio_fades = false;   // a rung of the radio's ladder has gone
  bool engine_off = false;    // we told the drive-by-wire to shut down
  const world::SensorInput* sensors = nullptr;  // of this tick; none: no clock is watched
  world::ComputerHealth computer{};
  // What the actuators were told last; unset while nothing was.
  world::ActuatorCommand reported{};
  double steering_ratio = 19.5;
  double speed_mps = kUnset;  // by the wheels
};

struct FaultState {
  bool positioned = false;  // ego was good once
  Instant last_good{};      // ego state last good
  std::uint8_t control_failed_ticks = 0, gate_refused_ticks = 0;
  bool bus_dead = false;
  Instant bus_dead_since{};  // when it was noticed
  FollowState steering, brake_front, brake_rear, throttle;
  OversteerState oversteer;
  ClockState clock;
  ComputerState computer;
};

struct FaultOutput {
  CauseSet causes;
  std::array<double, kCauses> values{};  // per cause that holds
  bool drive_by_wire_gone = false;       // the bus has been dead for bus_dead_disarm
  world::MonitorSet seen{};              // monitors that see something wrong now
};

FaultOutput detect(const FaultParams& params, FaultState& state, const FaultInputs& inputs,
                   Instant now);

// The car's speed by its wheels: the mean of the two middle ones of four, so that one wheel that
// locks, spins or lies has no say. Unset if older than `limit` or a wheel is not a number.
inline constexpr Duration kWheelAgeMax =
    milliseconds(250);  // for the speed that the car is judged by
double wheel_speed_mps(const world::VehicleSignals& signals, Instant now, Duration limit);

}  // namespace pitwall::safety
