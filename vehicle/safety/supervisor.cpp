// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/supervisor.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::safety {
namespace {

using world::ActuatorCommand;
using world::Mode;
using world::TrackFlag;
using world::Validity;
using world::VehicleFlag;

constexpr Duration kWheelAgeMax = milliseconds(250);
constexpr double kTickMax_s = 0.1;          // a longer pause does not open the slew limits
constexpr double kEgoStanding_mps = 1.0;    // wheels that lock at speed are no standstill
constexpr double kBrakeTouched_kpa = 50.0;  // with this much brake the throttle yields

struct Tick {
  const SupervisorParams& params;
  SupervisorState& state;
  const SupervisorInputs& in;
  Instant now;
  double speed_mps;
};

bool is_located(const world::EgoState& ego) {
  return ego.validity == Validity::kGood || ego.validity == Validity::kDeadReckoning;
}

bool seems_to_stand(const Tick& t) {
  const bool located = is_located(t.in.ego) && std::isfinite(t.in.ego.vx_mps);
  const double ego_mps = std::abs(t.in.ego.vx_mps);
  if (std::isfinite(t.speed_mps))
    return t.speed_mps < t.params.standstill_mps && (!located || ego_mps < kEgoStanding_mps);
  if (located) return ego_mps < t.params.standstill_mps;
  // Nothing measures the speed: the safe stop's dead reckoning is all there is.
  return t.state.safe_stop.active && t.state.safe_stop.speed_mps < t.params.standstill_mps;
}

bool stands(const Tick& t) {
  SupervisorState& s = t.state;
  const bool now_standing = seems_to_stand(t);
  if (now_standing && !s.standing) s.standing_since = t.now;
  s.standing = now_standing;
  return s.standing && t.now - s.standing_since >= t.params.standstill_dwell;
}

bool has(const CauseSet& causes, Reaction reaction) {
  for (const CauseRow& row : kCauseTable)
    if (row.reaction == reaction && causes.has(row.cause)) return true;
  return false;
}

bool bars_arming(const CauseSet& causes) {
  for (const CauseRow& row : kCauseTable)
    if (row.bars_arming && causes.has(row.cause)) return true;
  return false;
}

bool flags_let_roll(const Tick& t) {
  const world::RaceControl& rc = t.in.race_control;
  if (!rc.ever_heard) return !t.params.faults.race_control_required;
  const bool track = rc.track == TrackFlag::kYellow || rc.track == TrackFlag::kGreen ||
                     rc.track == TrackFlag::kWavingGreen;
  switch (rc.vehicle) {
    case VehicleFlag::kNone:
    case VehicleFlag::kBlue:
    case VehicleFlag::kYellow:
    case VehicleFlag::kDefender:
    case VehicleFlag::kAttacker:
      return track;
    default:
      return false;
  }
}

bool may_go(const Tick& t, const CauseSet& causes) {
  const auto& misc = t.in.signals.misc;
  const bool driving_state = misc.heard && misc.value.sys_state == world::SysState::kDriving;
  return causes.empty() && t.in.operator_requests.arm && t.in.drive_available &&
         (driving_state || !t.params.go_needs_driving_state) && flags_let_roll(t);
}

bool voids_arming(const CauseSet& causes) {
  for (const CauseRow& row : kCauseTable)
    if (row.voids_arming && causes.has(row.cause)) return true;
  return false;
}

// Of a request that is held while the car is disarmed and has not been spent.
Arming judge_request(const Tick& t, const CauseSet& causes) {
  if (t.in.last_run_armed && !t.state.arm_released) return Arming::kLastRunArmed;
  if (t.speed_mps >= t.params.standstill_mps) return Arming::kMoves;
  return bars_arming(causes) ? Arming::kBarred : Arming::kArmed;
}

// Whether the request arms in this tick. A refused one says why until it is withdrawn.
bool judge_arming(const Tick& t, const CauseSet& causes) {
  SupervisorState& s = t.state;
  const bool asked = t.in.operator_requests.arm;
  if (!asked) {
    s.arm_used = false;
    s.arm_released = true;
    s.arming = Arming::kNotAsked;
  } else if (s.mode != Mode::kDisarmed) {
    s.arming = Arming::kArmed;
  } else if (!s.arm_used) {
    s.arming = judge_request(t, causes);
    s.arm_used = is_refused(s.arming);
  } else if (!is_refused(s.arming)) {
    s.arming = Arming::kSpent;
  }
  return asked && !s.arm_used && s.arming == Arming::kArmed;
}

Events events_of(const Tick& t, const FaultOutput& found, bool standstill) {
  const CauseSet& causes = found.causes;
  SupervisorState& s = t.state;
  const OperatorRequests& op = t.in.operator_requests;
  const bool emergency = has(causes, Reaction::kEmergencyStop);
  const bool reset_edge = op.reset && !s.reset_was;
  s.reset_was = op.reset;
  Events events{};
  const auto set = [&](Event event, bool holds) {
    events[static_cast<std::size_t>(event)] = holds;
  };
  set(Event::kNobodyObeys, found.nobody_obeys);
  set(Event::kEmergency, emergency);
  set(Event::kStop, has(causes, Reaction::kControlledStop));
  set(Event::kStandstill, standstill);
  set(Event::kDisarm, !op.arm || voids_arming(causes));
  set(Event::kReset, reset_edge && !emergency);
  set(Event::kArm, judge_arming(t, causes));
  set(Event::kGo, may_go(t, causes));
  return events;
}

// Only what was to move is stopped: before that a cause bars driving and is logged.
bool is_stopped_by(Mode mode, Cause cause) {
  return mode == Mode::kDriving || stops(mode) ||
         (mode == Mode::kStandby && row_of(cause).reaction == Reaction::kEmergencyStop);
}

void log_rising(const Tick& t, const FaultOutput& found) {
  SupervisorState& s = t.state;
  if (s.mode == Mode::kDisarmed) {
    s.causes = {};
    return;
  }
  const CauseSet rising = found.causes.without(s.causes);
  s.causes = found.causes;
  for (const CauseRow& row : kCauseTable) {
    if (!rising.has(row.cause)) continue;
    const double value = found.values[static_cast<std::size_t>(row.cause)];
    s.log.record({t.now, row.cause, value}, is_stopped_by(s.mode, row.cause));
  }
}

void enter(const Tick& t, Mode to, bool nobody_obeys) {
  SupervisorState& s = t.state;
  if (to == Mode::kDisarmed) {
    s.last_known = false;
    // A car that disarmed by itself still says why.
    if (!nobody_obeys) s.log.forget_first();
  }
  if (to == Mode::kStandby) {
    s.log.forget_first();
    s.arm_used = true;
    s.last_shift = t.now;  // the gate counts the first gear that it sees as a shift
  }
  if (to == Mode::kStandby || to == Mode::kDriving) {
    s.safe_stop = {};
    s.safe_stop_engaged = false;
  }
  s.mode = to;
  s.mode_since = t.now;
}

double ramp_dt_s(const Tick& t) {
  return std::clamp((t.now - t.state.last_chosen).seconds(), 0.0, kTickMax_s);
}

bool is_usable(const ActuatorCommand& c) {
  return std::isfinite(c.road_wheel_rad) && c.throttle_fraction >= 0.0 &&
         c.throttle_fraction <= 1.0 && c.brake_kpa >= 0.0 && std::isfinite(c.brake_kpa);
}

struct Chosen {
  ActuatorCommand command;
  CommandSource source = CommandSource::kNone;
};

// At standstill: the brake is held and the steering stays where it is.
Chosen hold(const Tick& t) {
  const SupervisorState& s = t.state;
  const auto& motor = t.in.signals.steering_motor_rad;
  const double measured_rad = motor.heard ? motor.value / t.params.steering_ratio : 0.0;
  const auto& powertrain = t.in.signals.powertrain;
  const std::uint8_t reported = powertrain.heard ? powertrain.value.gear : std::uint8_t{0};
  return {{.at = t.now,
           .road_wheel_rad = s.last_known ? s.last.road_wheel_rad : measured_rad,
           .throttle_fraction = 0.0,
           .brake_kpa = t.params.safe_stop.hold_kpa,
           .gear = s.last_known ? s.last.gear : reported},
          CommandSource::kHold};
}

Chosen safe_stop(const Tick& t, StopKind kind) {
  SupervisorState& s = t.state;
  s.safe_stop_engaged = true;
  const SafeStopInputs inputs{t.in.stop, s.last, t.speed_mps, kind};
  return {stop_along(t.params.safe_stop, s.safe_stop, inputs, t.now), CommandSource::kSafeStop};
}

// On a flat road, beside the lateral acceleration that is measured.
Grip grip_now(const Tick& t) {
  const double speed_mps = std::isfinite(t.speed_mps) ? t.speed_mps : std::abs(t.in.ego.vx_mps);
  Grip grip = grip_at(t.params.safe_stop, std::isfinite(speed_mps) ? speed_mps : 0.0, 0.0, 0.0);
  if (std::isfinite(t.in.ego.ay_mps2)) grip.lateral_mps2 = t.in.ego.ay_mps2;
  return grip;
}

// Steering of control, brake as hard as the grip allows.
Chosen emergency(const Tick& t) {
  const SafeStopParams& p = t.params.safe_stop;
  ActuatorCommand command = t.in.control;
  const double emergency_kpa = brake_towards(p, StopKind::kEmergency,
                                             {.decel_mps2 = p.emergency_decel_mps2,
                                              .grip = grip_now(t),
                                              .last_kpa = t.state.last.brake_kpa,
                                              .dt_s = ramp_dt_s(t)});
  command.throttle_fraction = 0.0;
  command.brake_kpa = std::max(command.brake_kpa, emergency_kpa);
  return {command, CommandSource::kControl};
}

Chosen stopping(const Tick& t, bool control_usable) {
  const bool emergency_mode = t.state.mode == Mode::kEmergencyStop;
  const bool refused = t.state.faults.gate_refused_ticks >= t.params.faults.refused_ticks;
  if (t.state.safe_stop_engaged || !control_usable || !is_located(t.in.ego) || refused)
    return safe_stop(t, emergency_mode ? StopKind::kEmergency : StopKind::kControlled);
  return emergency_mode ? emergency(t) : Chosen{t.in.control, CommandSource::kControl};
}

Chosen choose(const Tick& t) {
  const SupervisorState& s = t.state;
  const bool usable = t.in.control_ok && is_usable(t.in.control);
  switch (s.mode) {
    case Mode::kDisarmed:
      return {};
    case Mode::kDriving:
      if (usable) return {t.in.control, CommandSource::kControl};
      return {s.last, CommandSource::kHold};  // known since standby
    case Mode::kControlledStop:
    case Mode::kEmergencyStop:
      return stopping(t, usable);
    case Mode::kStandby:
    case Mode::kHalted:
      break;
  }
  return hold(t);
}

// By the joystick: less throttle and more brake than was chosen, never the other way.
ActuatorCommand slowed(const Tick& t, const ActuatorCommand& chosen) {
  const RadioLadderOutput& radio = t.in.radio;
  ActuatorCommand out = chosen;
  out.throttle_fraction = std::min(chosen.throttle_fraction, radio.throttle_cap);
  if (radio.brake > 0.0) {
    const SafeStopParams& p = t.params.safe_stop;
    const double wanted_mps2 = radio.brake * p.decel_max_mps2;
    const double demand_kpa = brake_for(p, StopKind::kControlled, wanted_mps2, grip_now(t));
    out.brake_kpa = std::max(chosen.brake_kpa, demand_kpa);
  }
  return out;
}

// One gear at a time, and not sooner than the least time between two shifts.
std::uint8_t next_gear(const Tick& t, std::uint8_t wanted) {
  SupervisorState& s = t.state;
  const std::uint8_t gear = s.last.gear;
  if (wanted == gear || t.now - s.last_shift < t.params.shift_least) return gear;
  s.last_shift = t.now;
  return static_cast<std::uint8_t>(wanted > gear ? gear + 1 : gear - 1);
}

// A change of source is no jump; in a stop the throttle never rises.
ActuatorCommand limit(const Tick& t, const ActuatorCommand& wanted) {
  const SupervisorParams& p = t.params;
  ActuatorCommand out = wanted;
  if (t.state.last_known) {
    const ActuatorCommand& last = t.state.last;
    const double dt_s = ramp_dt_s(t);
    const double steer_rad = p.steer_slew_rad_per_s * dt_s;
    out.road_wheel_rad = std::clamp(wanted.road_wheel_rad, last.road_wheel_rad - steer_rad,
                                    last.road_wheel_rad + steer_rad);
    out.brake_kpa = std::clamp(wanted.brake_kpa, last.brake_kpa - p.brake_fall_kpa_per_s * dt_s,
                               last.brake_kpa + p.brake_rise_kpa_per_s * dt_s);
    out.throttle_fraction =
        std::min(wanted.throttle_fraction, last.throttle_fraction + p.throttle_rise_per_s * dt_s);
    if (t.state.mode != Mode::kDriving)
      out.throttle_fraction = std::min(out.throttle_fraction, last.throttle_fraction);
    out.gear = next_gear(t, wanted.gear);
  }
  if (out.brake_kpa > kBrakeTouched_kpa) out.throttle_fraction = 0.0;
  return out;
}

Follow follow_of(Mode mode) {
  if (mode == Mode::kDriving) return Follow::kDrive;
  return stops(mode) ? Follow::kStop : Follow::kNone;
}

}  // namespace

const char* text_of(Arming arming) {
  switch (arming) {
    case Arming::kNotAsked:
      return "not asked";
    case Arming::kArmed:
      return "armed";
    case Arming::kBarred:
      return "waits for a fault to pass";
    case Arming::kMoves:
      return "REFUSED: the car moves";
    case Arming::kLastRunArmed:
      return "REFUSED: the last run ended while armed";
    case Arming::kSpent:
      return "SPENT: release and arm anew";
  }
  return "?";
}

SupervisorOutput supervise(const SupervisorParams& params, SupervisorState& state,
                           const SupervisorInputs& inputs, Instant now) {
  const double speed_mps = wheel_speed_mps(inputs.signals, now, kWheelAgeMax);
  const Tick tick{params, state, inputs, now, speed_mps};
  const FaultOutput found = detect(params.faults, state.faults,
                                   {.signals = inputs.signals,
                                    .bus = inputs.bus,
                                    .race_control = inputs.race_control,
                                    .ego = inputs.ego,
                                    .watchdog = inputs.watchdog,
                                    .operator_requests = inputs.operator_requests,
                                    .radio_stop = inputs.radio.stop,
                                    .own_id_seen = inputs.own_id_seen,
                                    .bus_failed = inputs.bus_failed,
                                    .control_ok = inputs.control_ok && is_usable(inputs.control),
                                    .gate_refused = inputs.gate_refused,
                                    .driving = state.mode == Mode::kDriving},
                                   now);
  const bool standstill = stands(tick);
  log_rising(tick, found);
  const Mode before = state.mode;
  const Mode to = next(before, events_of(tick, found, standstill));
  if (to != before) enter(tick, to, found.nobody_obeys);

  SupervisorOutput out;
  const Chosen chosen = choose(tick);
  if (chosen.source != CommandSource::kNone) {
    out.command = limit(tick, slowed(tick, chosen.command));
    out.limited = out.command.road_wheel_rad != chosen.command.road_wheel_rad ||
                  out.command.brake_kpa != chosen.command.brake_kpa ||
                  out.command.throttle_fraction != chosen.command.throttle_fraction;
    state.last = out.command;
    state.last_known = true;
    state.last_chosen = now;
  }
  out.source = chosen.source;
  out.arming = state.mode == Mode::kDisarmed ? state.arming : Arming::kArmed;
  out.mode = state.mode;
  out.mode_changed = to != before;
  out.cause = state.log.first.cause;
  out.causes = found.causes;
  out.follow = follow_of(state.mode);
  out.actuate = state.mode != Mode::kDisarmed;
  out.speed_mps = speed_mps;
  out.standstill = standstill;
  return out;
}

}  // namespace pitwall::safety
