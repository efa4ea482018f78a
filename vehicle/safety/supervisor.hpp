// The system executive: which mode the car is in, why, which trajectory to follow and whose command
// goes to the actuators. Planning keeps a stop trajectory ready at every tick; in a stop the car is
// driven along it by safe_stop, and control is not asked.
//   in     signals received, position, what was learned of the steering, the watchdog's rows, the
//          verdicts of this tick's control and of the previous tick's gate, the operator's requests
//   out    mode, cause (the first that stopped the car since the last reset), command, what to
//          follow in the next tick
//   units  SI
//   joystick it can lower the throttle and raise the brake of whatever was chosen, within the grip
//          of the tyres and before the slew limits; it never steers
//   errors none: every fault is a Cause with a value and an entry in the fault log
//   coast  what may pass (Reaction::kCoast) takes the throttle away in the tick in which it is
//          seen; the line is held and the brake is free. coast_dwell after the last sign of it the
//          car drives on; where it lasts for coast_max the car stops
//   arming a request arms once. While a fault bars it, it waits; it is refused, and spent, when the
//          wheels turn (a process that begins while the car moves must not take it over) or when it
//          has been held since the start of a process whose predecessor ended while armed. A spent
//          request counts for nothing: it must be withdrawn and given anew, as after every stop,
//          after a base station lost at standstill and after a dead bus
//   brake  a stop whose steering strays, or that has neither position nor inertial unit, brakes as
//          an emergency does: where the path cannot be held, what is left is to be slower
//   engine off at standstill only, but for one case: a throttle that stays open in a stop, at any
//          speed. The drive-by-wire is then told to shut down as in an emergency (CT 12): the
//          engine is off, the gear is out, steering and brake still follow commands
//   source mission, row 4 (system executive); mode_table.hpp for the transitions
//
//           fault                   stands for 0.5 s           reset
//   Driving -----> ControlledStop -------------------> Halted ------> Disarmed
//    ^  ^ \ may pass      | emergency                     ^              | arm, released and given
//    |  |  v     lasts    v                               |              v anew after a stop
//    |  Coast --------> a stop; EmergencyStop ------------+           Standby
//    | go
//   Standby
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/safety/fault_detection.hpp"
#include "vehicle/safety/fault_log.hpp"
#include "vehicle/safety/frame_gate.hpp"
#include "vehicle/safety/link_loss_policy.hpp"
#include "vehicle/safety/mode_table.hpp"
#include "vehicle/safety/safe_stop.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/mode.hpp"
#include "vehicle/world/monitor.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::safety {

struct SupervisorParams {
  FaultParams faults;
  SafeStopParams safe_stop;
  double steering_ratio = 19.5;  // as in gateway::OutboundParams
  GateParams gate;               // what a stop's own commands have to pass
  Duration standstill_dwell = milliseconds(500);
  double standstill_mps = 0.3;
  // Slew of the chosen command, so that a change of its source is no jump; below the gate's limits.
  double steer_slew_rad_per_s = 0.5;  // at the road wheel
  double throttle_rise_per_s = 2.0;   // fraction per second
  double brake_fall_kpa_per_s = 30000.0;
  Duration shift_least = milliseconds(150);  // one gear at a time; [0.1, 2] s
  double brake_rise_kpa_per_s = 15000.0;
  bool go_needs_driving_state = true;  // drive-by-wire must say "driving" first
  Duration coast_dwell = milliseconds(500);
  Duration coast_max = milliseconds(1500);  // above coast_dwell
  double coast_brakes_below_mps = 5.0;      // where the brake stays free no longer
};

inline FollowingParams following_of(const SupervisorParams& p) {
  return {p.safe_stop, p.gate, p.steering_ratio, p.steer_slew_rad_per_s};
}

inline constexpr auto kSupervisorRanges = std::to_array<world::NamedRange<SupervisorParams>>({
    {"standstill_mps", &SupervisorParams::standstill_mps, 0.1, 1.0},
    {"steer_slew_rad_per_s", &SupervisorParams::steer_slew_rad_per_s, 0.1, 2.0},
    {"throttle_rise_per_s", &SupervisorParams::throttle_rise_per_s, 0.1, 10.0},
    {"brake_rise_kpa_per_s", &SupervisorParams::brake_rise_kpa_per_s, 1000.0, 30000.0},
    {"brake_fall_kpa_per_s", &SupervisorParams::brake_fall_kpa_per_s, 1000.0, 60000.0},
    {"coast_brakes_below_mps", &SupervisorParams::coast_brakes_below_mps, 1.0, 20.0},
});

inline constexpr auto kSupervisorTimes = std::to_array<world::NamedTime<SupervisorParams>>({
    {"standstill_dwell_s", &SupervisorParams::standstill_dwell, 0.1, 5.0},
    {"coast_dwell_s", &SupervisorParams::coast_dwell, 0.1, 5.0},
    {"coast_max_s", &SupervisorParams::coast_max, 0.2, 10.0},
});

enum class Follow : std::uint8_t { kNone, kDrive, kStop };
// What becomes of the operator's wish to be armed.
enum class Arming : std::uint8_t {
  kNotAsked,
  kArmed,
  kBarred,        // waits for a fault to pass
  kMoves,         // refused
  kLastRunArmed,  // refused
  kSpent          // has armed once
};
constexpr bool is_refused(Arming arming) {
  return arming == Arming::kMoves || arming == Arming::kLastRunArmed;
}
const char* text_of(Arming arming);
enum class CommandSource : std::uint8_t { kNone, kHold, kControl, kSafeStop };

struct SupervisorInputs {
  const world::VehicleSignals& signals;
  const world::BusHealth& bus;
  const world::RaceControl& race_control;
  const world::EgoState& ego;
  const WatchdogOutput& watchdog;
  const world::Trajectory& stop;          // the newest stop trajectory, may be empty
  const world::ActuatorCommand& control;  // of this tick; read only if control_ok, while it drives
  bool control_ok = false;
  bool drive_available = false;  // planning has a drive trajectory
  bool own_id_seen = false;      // gateway::InboundOutput
  bool bus_failed = false;       // BusGuardOutput
  bool gate_refused = false;     // GateOutput::refused_now of the previous tick
  OperatorRequests operator_requests;
  bool last_run_armed = false;  // the run of this process before ended while armed
  LinkLossOutput radio{};       // what is left of the joystick; whether the link's age stops
  const world::SensorInput* sensors = nullptr;  // of this tick
  world::ComputerHealth computer{};
  steering::Learned learned{};
};

struct SupervisorState {
  world::Mode mode = world::Mode::kDisarmed;
  Instant mode_since{};
  FaultState faults;
  FaultLog log;
  CauseSet causes;       // of the previous tick: its rising edges are logged
  FaultEntry coasts;     // why the car coasts
  Instant coast_last{};  // when a reason for it held last
  SafeStopState safe_stop;
  bool reset_was = false;
  bool standing = false;
  Instant standing_since{};
  bool engine_off = false;  // until the car is armed again
  // Likewise, in a stop: its steering strayed; it had neither a position nor an inertial unit.
  bool steering_strayed = false, was_blind = false;
  bool arm_used = false;      // an arm request arms once; cleared when it is withdrawn
  bool arm_released = false;  // no request was held at least once since the start
  Arming arming = Arming::kNotAsked;
  world::ActuatorCommand last;  // the last command that was chosen
  bool last_known = false;
  Instant last_chosen{};
  Instant last_shift{};
};
static_assert(std::is_trivially_copyable_v<SupervisorState>);

struct SupervisorOutput {
  world::Mode mode = world::Mode::kDisarmed;
  bool mode_changed = false;
  Cause cause = Cause::kNone;      // first since the last reset or arming; text_of(cause)
  CauseSet causes;                 // all that hold now
  Follow follow = Follow::kNone;   // what planning and control shall follow in the next tick
  world::ActuatorCommand command;  // unset while disarmed
  CommandSource source = CommandSource::kNone;
  Arming arming = Arming::kNotAsked;
  bool actuate = false;       // armed: outbound sends actuator frames and the gate lets them pass
  double speed_mps = kUnset;  // by the wheels
  bool standstill = false;
  bool engine_off = false;   // the throttle does not close in a stop
  bool limited = false;      // the slew limits changed the command
  world::MonitorSet seen{};  // monitors that see something wrong now
};

SupervisorOutput supervise(const SupervisorParams& params, SupervisorState& state,
                           const SupervisorInputs& inputs, Instant now);

}  // namespace pitwall::safety
