// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/supervisor.hpp"

#include <cmath>

#include "vehicle/safety/command_choice.hpp"

namespace pitwall::safety {
namespace {

using world::ActuatorCommand;
using world::Mode;
using world::Validity;

constexpr double kEgoStanding_mps = 1.0;  // wheels that lock at speed are no standstill

bool is_at_standstill(const Tick& t) {
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
  const bool at_standstill = is_at_standstill(t);
  if (at_standstill && !s.standing) s.standing_since = t.now;
  s.standing = at_standstill;
  return s.standing && t.now - s.standing_since >= t.params.standstill_dwell;
}

bool has(const CauseSet& causes, Reaction reaction) {
  for (const CauseRow& row : kCauseTable)
    if (row.reaction == reaction && causes.has(row.cause)) return true;
  return false;
}

bool bars_arming(const CauseSet& causes) {
  for (const CauseRow& row : kCauseTable)
    if (row.arms != ArmingEffect::kAllows && causes.has(row.cause)) return true;
  return false;
}

bool flags_allow_motion(const Tick& t) {
  const world::RaceControl& rc = t.in.race_control;
  if (!rc.ever_received) return !t.params.faults.race_control_required;
  const world::FlagDemand demand = demand_of(rc.track, rc.vehicle);
  return demand == world::FlagDemand::kRace || demand == world::FlagDemand::kCaution;
}

bool may_go(const Tick& t, const CauseSet& causes) {
  const auto& misc = t.in.signals.misc;
  const bool driving_state = misc.received && misc.value.sys_state == world::SysState::kDriving;
  const bool healthy = causes.at_least(Reaction::kCoast).empty();
  return healthy && t.in.operator_requests.arm && t.in.drive_available &&
         (driving_state || !t.params.go_needs_driving_state) && flags_allow_motion(t);
}

bool revokes_arming(const CauseSet& causes) {
  for (const CauseRow& row : kCauseTable)
    if (row.arms == ArmingEffect::kRevokes && causes.has(row.cause)) return true;
  return false;
}

// Of a request that is held while the car is disarmed and has not been spent.
Arming judge_request(const Tick& t, const CauseSet& causes) {
  if (t.in.last_run_armed && !t.state.arm_released) return Arming::kLastRunArmed;
  if (t.speed_mps >= t.params.standstill_mps) return Arming::kCarMoves;
  return bars_arming(causes) ? Arming::kBarred : Arming::kArmed;
}

// Whether the request arms in this tick. A refused one says why until it is withdrawn.
bool judge_arming(const Tick& t, const CauseSet& causes) {
  SupervisorState& s = t.state;
  const bool asked = t.in.operator_requests.arm;
  if (!asked) {
    s.arm_used = false;
    s.arm_released = true;
    s.arming = Arming::kNotRequested;
  } else if (s.mode != Mode::kDisarmed) {
    s.arming = Arming::kArmed;
  } else if (!s.arm_used) {
    s.arming = judge_request(t, causes);
    s.arm_used = is_refused(s.arming);
  } else if (!is_refused(s.arming)) {
    s.arming = Arming::kUsed;
  }
  return asked && !s.arm_used && s.arming == Arming::kArmed;
}

// What may pass: is it there, has it passed, has it lasted too long?
struct Coasting {
  bool begins = false, passed = false, too_long = false;
};
Coasting coasting(const Tick& t, const CauseSet& causes) {
  SupervisorState& s = t.state;
  Coasting out;
  out.begins = has(causes, Reaction::kCoast);
  if (out.begins) s.coast_last = t.now;
  if (s.mode != Mode::kCoast) return out;
  out.passed = t.now - s.coast_last >= t.params.coast_dwell;
  out.too_long = !out.passed && t.now - s.mode_since >= t.params.coast_max;
  return out;
}

Events events_of(const Tick& t, const FaultOutput& found, bool standstill) {
  const CauseSet& causes = found.causes;
  SupervisorState& s = t.state;
  const OperatorRequests& op = t.in.operator_requests;
  const bool emergency = has(causes, Reaction::kEmergencyStop);
  const Coasting coast = coasting(t, causes);
  const bool reset_edge = op.reset && !s.reset_was;
  s.reset_was = op.reset;
  Events events{};
  const auto set = [&](Event event, bool holds) {
    events[static_cast<std::size_t>(event)] = holds;
  };
  set(Event::kDriveByWireGone, found.drive_by_wire_gone);
  set(Event::kEmergency, emergency);
  set(Event::kStop, has(causes, Reaction::kControlledStop) || coast.too_long);
  set(Event::kCoast, coast.begins);
  set(Event::kPassed, coast.passed);
  set(Event::kStandstill, standstill);
  set(Event::kDisarm, !op.arm || revokes_arming(causes));
  set(Event::kReset, reset_edge && !emergency);
  set(Event::kArm, judge_arming(t, causes));
  set(Event::kGo, may_go(t, causes));
  return events;
}

// Only what was to move is stopped: before that a cause bars driving and is logged.
bool is_stopped_by(Mode mode, Cause cause) {
  const Reaction reaction = row_of(cause).reaction;
  const bool moves = follows_the_drive(mode) || stops(mode);
  return (moves && reaction >= Reaction::kControlledStop) ||
         (mode == Mode::kStandby && reaction == Reaction::kEmergencyStop);
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
    const FaultEntry entry{t.now, row.cause, value};
    s.log.record(entry, is_stopped_by(s.mode, row.cause));
    if (row.reaction == Reaction::kCoast && s.coasts.cause == Cause::kNone) s.coasts = entry;
  }
}

void enter(const Tick& t, Mode to, bool drive_by_wire_gone) {
  SupervisorState& s = t.state;
  if (to == Mode::kDisarmed) {
    s.last_known = false;
    // A car that disarmed by itself still says why.
    if (!drive_by_wire_gone) s.log.clear_first();
  }
  if (to == Mode::kStandby) {
    s.log.clear_first();
    s.arm_used = true;
    s.last_shift = t.now;  // the gate counts the first gear that it sees as a shift
  }
  if (to == Mode::kStandby || to == Mode::kDriving) {
    s.safe_stop = {};
    s.engine_off = s.steering_deviated = s.had_no_guidance = false;
    s.steering_bias_rad = 0.0;
    s.coasts = {};
  }
  // What lasted too long is what stopped the car.
  if (s.mode == Mode::kCoast && stops(to) && s.log.first.cause == Cause::kNone)
    s.log.first = s.coasts;
  s.mode = to;
  s.mode_since = t.now;
}

// A stop tells the throttle to close. Where it stays open the brakes fight the engine, and lose in
// the low gears.
bool throttle_stuck_open(const Tick& t, const FaultOutput& found) {
  const SupervisorState& s = t.state;
  const auto& throttle = t.in.signals.throttle_fraction;
  return stops(s.mode) && found.causes.has(Cause::kThrottleDeviates) && s.last_known &&
         throttle.value > s.last.throttle_fraction + t.params.faults.following.throttle.tolerance;
}

void note_lost_guidance(const Tick& t, const FaultOutput& found) {
  SupervisorState& s = t.state;
  if (!stops(s.mode)) return;
  const bool placed = t.in.ego.validity == Validity::kGood;
  s.had_no_guidance = s.had_no_guidance || (found.causes.has(Cause::kImuLost) && !placed);
  if (found.steering_biased && s.steering_bias_rad == 0.0)
    s.steering_bias_rad = t.in.learned.innovation_rad;
  s.steering_deviated = s.steering_deviated ||
                        (found.causes.has(Cause::kSteeringDeviates) && s.steering_bias_rad == 0.0);
}

Follow follow_of(Mode mode) {
  if (follows_the_drive(mode)) return Follow::kDrive;
  return stops(mode) ? Follow::kStop : Follow::kNone;
}

}  // namespace

const char* text_of(Arming arming) {
  switch (arming) {
    case Arming::kNotRequested:
      return "not asked";
    case Arming::kArmed:
      return "armed";
    case Arming::kBarred:
      return "waits for a fault to pass";
    case Arming::kCarMoves:
      return "REFUSED: the car moves";
    case Arming::kLastRunArmed:
      return "REFUSED: the last run ended while armed";
    case Arming::kUsed:
      return "SPENT: release and arm anew";
  }
  return "?";
}

SupervisorOutput supervise(const SupervisorParams& params, SupervisorState& state,
                           const SupervisorInputs& inputs, Instant now) {
  const double speed_mps = wheel_speed_mps(inputs.signals, now, kWheelAgeMax);
  Tick tick{params, state, inputs, now, speed_mps};
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
                                    .driving = follows_the_drive(state.mode),
                                    .moves = follows_the_drive(state.mode) || stops(state.mode),
                                    .radio_fades = inputs.radio.level != LinkLossLevel::kFull,
                                    .engine_off = state.engine_off,
                                    .sensors = inputs.sensors,
                                    .computer = inputs.computer,
                                    .reported = state.last_known ? state.last : ActuatorCommand{},
                                    .steering_ratio = params.steering_ratio,
                                    .wheelbase_m = params.safe_stop.steering.bicycle.wheelbase_m,
                                    .lock_slip = params.safe_stop.lock_slip,
                                    .innovation_rad = inputs.learned.innovation_rad,
                                    .innovation_sigma_rad = inputs.learned.innovation_sigma_rad,
                                    .speed_mps = speed_mps},
                                   now);
  tick.slip = {found.front_slip, found.oversteers};
  const bool standstill = stands(tick);
  log_rising(tick, found);
  const Mode before = state.mode;
  const Mode to = next(before, events_of(tick, found, standstill));
  if (to != before) enter(tick, to, found.drive_by_wire_gone);
  state.engine_off = state.engine_off || throttle_stuck_open(tick, found);
  note_lost_guidance(tick, found);

  SupervisorOutput out;
  const ChosenCommand chosen = choose(tick);
  if (chosen.source != CommandSource::kNone) {
    out.command = shape(tick, chosen.command);
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
  out.engine_off = state.engine_off;
  out.seen = found.seen;
  return out;
}

}  // namespace pitwall::safety
