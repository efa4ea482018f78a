// Model of the car's drive-by-wire computer (Raptor, with SpaceDrive and engine control): receives
// the commands of the autonomy computer, moves the actuators, reports on the bus.
//   in     frames that its port received since the last step (commands 1400-1404 of the
//          computer and 1200, 1250 of race control; others are ignored), Feedback, now
//   out    reports that are due (to be offered to the bus at `now`), Demand for the plant
//   rate   call every 1 to 5 ms; a report whose period passed more than once between two calls is
//          sent once, and the others are counted as skipped; late calls do not shift the due times
//   units  as in feedback.hpp
//   errors undecodable frames, duplicates and unsendable reports are counted in Counters
//   cost   no allocation
//   source research: cycle times as the public AV-24 bridge mirrors them; RaptorSM (states). The
//          real watchdog is not public, so the rules below are those of this bench:
//
// Watchdog. While the car may drive (states 8, 9 with CT 7..10) the counters of brake, accelerator
// and steering command must each change within `command_timeout`. Otherwise, and until the car
// stands and commands arrive again: throttle 0, brake ramps to `emergency_brake_kpa`, steering
// holds, adlink_hb_lost and est6_sd_ebrake are set. Outside driving, adlink_hb_lost means that a
// ct_report counter was received once and has not changed for `ct_timeout`; it has no effect then.
// CT 10: commands are followed as in 7..9 (the computer stops the car itself).
// CT 11, engine kill: engine off, throttle 0; steering and brake follow a live computer.
// CT 12: as CT 11, but the brake is the larger of the command and the emergency ramp.
// Otherwise: throttle 0, neutral, steering holds, brake ramps to `standby_brake_kpa`.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hil/nodes/feedback.hpp"
#include "hil/nodes/reports.hpp"
#include "hil/nodes/system_state.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/race_control.hpp"

namespace pitwall::drive_by_wire {

struct Params {
  // begins in state 9 with the engine on, for scenarios that start at speed
  bool hot_start = false;
  world::FlagEncoding encoding = world::FlagEncoding::kMyLaps;
  Duration command_timeout = milliseconds(100);
  Duration ct_timeout = milliseconds(1500);
  Duration race_control_timeout = seconds(10);      // research: rc_base_sync_check falls after 10 s
  Duration starter_time = milliseconds(1500);       // delay of fuel and ignition after the starter
  Duration misc_report_period = milliseconds(500);  // the public period; 100 ms for a faster state
  double emergency_brake_kpa = 1800.0;              // TUM's manual emergency brake
  double standby_brake_kpa = 1500.0;
  double brake_ramp_kpa_per_s = 3000.0;
  double brake_max_kpa = 6000.0;
  double rear_brake_ratio = 1.0;        // rear pressure = ratio * front pressure
  double brake_tolerance_kpa = 600.0;   // est1, est2 if exceeded for `tolerance_time`
  double steering_tolerance_rad = 0.5;  // sd_steer_warning1 likewise
  Duration tolerance_time = milliseconds(500);
  double low_engine_rpm = 800.0;  // est3
  double standstill_mps = 0.5;
};

// Active faults, set by the bench.
struct ActuatorFaults {
  bool steering_stuck = false, throttle_stuck = false;  // at the demand of the start of the fault
  // the motor goes to demand + bias; its sensor does not measure the bias
  double steering_bias_rad = 0.0;
  double steering_rate_rad_per_s = 0;  // slow motor; 0: no limit here, the plant has its own
  double brake_leak = 0.0;             // lost share of the pressure, 0..1
  double brake_stuck_kpa = kUnset;     // in both circuits, independent of the demand
};

struct Counters {
  std::uint64_t undecoded = 0;   // command identifier with wrong length or kind of frame
  std::uint64_t duplicates = 0;  // counter unchanged: command ignored
  std::uint64_t skipped = 0;     // reports not sent because step() was called too rarely
  std::uint64_t unsent = 0;      // reports with a number that is not finite
  std::uint64_t saturated = 0;   // signals out of their range
};

struct CommandStream {
  double value = 0.0;
  int counter = -1;  // none received yet
  Instant changed{};
};

struct State {
  bool begun = false;
  world::SysState system = world::SysState::kPowerOn;
  Instant system_since{}, last_step{};
  CommandStream brake_kpa, throttle_percent, steering_deg, ct;
  world::CtState ct_state = world::CtState::kDefault;
  std::uint8_t gear = 0;
  Instant driving_since{};
  bool may_drive = false, watchdog = false;
  int race_heartbeat = -1;
  Instant race_received{};  // last change of the heartbeat, or the start
  bool orange = false, engine_kill = false;
  Demand demand;  // last demand to the actuators, before faults
  Demand acted;   // demand to the plant, after faults
  ActuatorFaults faults;
  Instant front_in_tolerance{}, rear_in_tolerance{}, steering_in_tolerance{};
  Diagnostics diagnostics;
  ReportState reports;
  Counters counters;
};

struct Output {
  ReportFrames frames;
  Demand demand;
  world::SysState system = world::SysState::kPowerOn;
  bool watchdog = false;
};

Output step(const Params& params, State& state, std::span<const can::ReceivedFrame> received,
            const Feedback& feedback, Instant now);

}  // namespace pitwall::drive_by_wire
