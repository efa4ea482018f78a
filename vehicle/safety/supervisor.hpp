// Supervisor (system executive): mode of the car, cause, trajectory to follow, and command to the
// actuators. Planning provides a new stop trajectory in every tick; in a stop safe_stop drives the
// car along it, and control is not used.
//   in     received signals, ego state, learned correction of the steering, watchdog rows, verdicts
//          of control in this tick and of the gate in the previous tick, the operator's requests
//   out    mode, cause (the first that stopped the car since the last reset), command, trajectory
//          to follow in the next tick
//   units  SI
//   joystick it can lower the throttle and raise the brake of the chosen command, within the grip
//          of the tyres and before the slew limits; it never steers
//   errors none: every fault is a Cause with a value and an entry in the fault log
//   coast  a cause of Reaction::kCoast sets the throttle to zero in the tick in which it is
//          detected; the car holds its line without brake. coast_dwell after the cause last held
//          the car drives on; after coast_max of coasting it stops
//   arming an arm request arms once. While a fault bars arming, the request waits. It is refused,
//          and spent, if the wheels turn (a process that starts while the car moves must not take
//          it over) or if it has been held since the start of a process whose predecessor ended
//          while armed. A spent request has no effect: it must be withdrawn and set again, as after
//          every stop, after a base station lost at standstill and after a dead bus
//   brake  a stop brakes as an emergency does if its steering does not follow, or if it has neither
//          position nor inertial unit: when the path cannot be held, less speed is safer
//   engine shut down at standstill only, with one exception: a throttle that stays open in a stop,
//          at any speed. The drive-by-wire then gets the shut-down of an emergency (CT 12): the
//          engine is off and the gear disengaged; steering and brake still follow commands
//   source mission, row 4 (system executive); mode_table.hpp for the transitions
//
//           fault                   stands for 0.5 s           reset
//   Driving -----> ControlledStop -------------------> Halted ------> Disarmed
//    ^  ^ \ kCoast        | emergency                     ^              | arm (after a stop a
//    |  |  v     lasts    v                               |              v new request)
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
  GateParams gate;               // limits for the commands of a stop
  Duration standstill_dwell = milliseconds(500);
  double standstill_mps = 0.3;
  // Slew limits of the chosen command, so that a change of source causes no jump; below the limits
  // of the gate.
  double steer_slew_rad_per_s = 0.5;  // at the road wheel
  double throttle_rise_per_s = 2.0;   // fraction per second
  double brake_fall_kpa_per_s = 30000.0;
  Duration shift_least = milliseconds(150);  // minimum time between shifts; [0.1, 2] s
  double brake_rise_kpa_per_s = 15000.0;
  bool go_needs_driving_state = true;  // drive-by-wire must report "driving" first
  Duration coast_dwell = milliseconds(500);
  Duration coast_max = milliseconds(1500);  // above coast_dwell
  double coast_brakes_below_mps = 5.0;      // below it coasting keeps control's brake
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
// State of the operator's arm request.
enum class Arming : std::uint8_t {
  kNotRequested,
  kArmed,
  kBarred,        // waits for a fault to pass
  kCarMoves,      // refused
  kLastRunArmed,  // refused
  kUsed           // has armed once
};
constexpr bool is_refused(Arming arming) {
  return arming == Arming::kCarMoves || arming == Arming::kLastRunArmed;
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
  const world::ActuatorCommand& control;  // of this tick; read only if control_ok, while driving
  bool control_ok = false;
  bool drive_available = false;  // planning has a drive trajectory
  bool own_id_seen = false;      // gateway::InboundOutput
  bool bus_failed = false;       // BusGuardOutput
  bool gate_refused = false;     // GateOutput::refused_now of the previous tick
  OperatorRequests operator_requests;
  bool last_run_armed = false;  // the previous run of this process ended while armed
  LinkLossOutput radio{};       // link-loss policy: joystick inputs, stop
  const world::SensorInput* sensors = nullptr;  // of this tick
  world::ComputerHealth computer{};
  steering::Learned learned{};
};

struct SupervisorState {
  world::Mode mode = world::Mode::kDisarmed;
  Instant mode_since{};
  FaultState faults;
  FaultLog log;
  CauseSet causes;       // of the previous tick, to log rising edges
  FaultEntry coasts;     // why the car coasts
  Instant coast_last{};  // when a cause of kCoast held last
  SafeStopState safe_stop;
  bool reset_was = false;
  bool standing = false;
  Instant standing_since{};
  bool engine_off = false;  // stays set until the car is armed again
  // Set in a stop, until the car is armed again: the steering did not follow; neither position nor
  // inertial unit was available.
  bool steering_deviated = false, had_no_guidance = false;
  double steering_bias_rad = 0.0;  // likewise: road-wheel angle that the sensor does not show
  bool arm_used = false;           // an arm request arms once; cleared when it is withdrawn
  bool arm_released = false;       // the request was absent at least once since the start
  Arming arming = Arming::kNotRequested;
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
  CauseSet causes;                 // all that hold in this tick
  Follow follow = Follow::kNone;   // trajectory for the next tick
  world::ActuatorCommand command;  // unset while disarmed
  CommandSource source = CommandSource::kNone;
  Arming arming = Arming::kNotRequested;
  bool actuate = false;       // armed: outbound sends actuator frames and the gate lets them pass
  double speed_mps = kUnset;  // from the wheels
  bool standstill = false;
  bool engine_off = false;   // the throttle does not close in a stop
  bool limited = false;      // the slew limits changed the command
  world::MonitorSet seen{};  // monitors with a finding in this tick
};

SupervisorOutput supervise(const SupervisorParams& params, SupervisorState& state,
                           const SupervisorInputs& inputs, Instant now);

}  // namespace pitwall::safety
