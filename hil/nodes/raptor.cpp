// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/raptor.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/can/av21.hpp"

namespace pitwall::drive_by_wire {
namespace {

namespace av21 = can::av21;
using world::CtState;
using world::SysState;

constexpr std::uint8_t kMyLapsOrange = 2, kMarelliOrange = 25, kMarelliEngineKill = 33;
constexpr double kGearMax = 6.0;

void begin(const Params& params, State& state, Instant now) {
  state.begun = true;
  state.system = params.hot_start ? SysState::kDriving : SysState::kPowerOn;
  state.system_since = state.last_step = state.race_received = now;
  state.front_in_tolerance = state.rear_in_tolerance = state.steering_in_tolerance = now;
}

template <class Message>
bool decoded(const can::Frame& frame, Message& message, Counters& counters) {
  if (av21::decode(frame, message)) return true;
  ++counters.undecoded;
  return false;
}

// A command counts only when its counter moved: the same counter is a repeated frame.
void take(CommandStream& stream, double value, double counter, Instant now, Counters& counters) {
  const int incoming = static_cast<int>(counter);
  if (incoming == stream.counter) {
    ++counters.duplicates;
    return;
  }
  stream = {value, incoming, now};
}

void hear_ct_report(State& state, const can::Frame& frame, Instant now) {
  av21::CtReport m;
  if (!decoded(frame, m, state.counters)) return;
  const bool known = m.ct_state >= 1.0 && m.ct_state <= 12.0;
  state.ct_state = known ? static_cast<CtState>(m.ct_state) : CtState::kDefault;
  take(state.ct, m.ct_state, m.ct_state_rolling_counter, now, state.counters);
}

void hear_race_control(const Params& params, State& state, const can::Frame& frame, Instant now) {
  if (params.encoding == world::FlagEncoding::kMyLaps) {
    av21::BaseToCarSummary m;
    if (frame.id != m.kId || !decoded(frame, m, state.counters)) return;
    state.orange = m.track_flag == kMyLapsOrange;
    const int heartbeat = static_cast<int>(m.base_to_car_heartbeat);
    if (heartbeat != state.race_heartbeat) state.race_received = now;
    state.race_heartbeat = heartbeat;
    return;
  }
  av21::MarelliReport1 m;
  if (frame.id != m.kId || !decoded(frame, m, state.counters)) return;
  state.orange = m.marelli_vehicle_flag == kMarelliOrange;
  state.engine_kill = m.marelli_vehicle_flag == kMarelliEngineKill;
  if (m.marelli_rc_base_sync_check == 1.0) state.race_received = now;
}

void receive(const Params& params, State& state, const can::Frame& frame, Instant now) {
  switch (frame.id) {
    case av21::BrakePressureCmd::kId: {
      av21::BrakePressureCmd m;
      if (decoded(frame, m, state.counters))
        take(state.brake_kpa, m.brake_pressure_cmd, m.brk_pressure_cmd_counter, now,
             state.counters);
      return;
    }
    case av21::AcceleratorCmd::kId: {
      av21::AcceleratorCmd m;
      if (decoded(frame, m, state.counters))
        take(state.throttle_percent, m.acc_pedal_cmd, m.acc_pedal_cmd_counter, now, state.counters);
      return;
    }
    case av21::SteeringCmd::kId: {
      av21::SteeringCmd m;
      if (decoded(frame, m, state.counters))
        take(state.steering_deg, m.steering_motor_ang_cmd, m.steering_motor_cmd_counter, now,
             state.counters);
      return;
    }
    case av21::GearShiftCmd::kId: {
      av21::GearShiftCmd m;
      if (decoded(frame, m, state.counters) && m.desired_gear <= kGearMax)
        state.gear = static_cast<std::uint8_t>(m.desired_gear);
      return;
    }
    case av21::CtReport::kId:
      return hear_ct_report(state, frame, now);
    default:
      return hear_race_control(params, state, frame, now);
  }
}

bool live(const CommandStream& stream, Duration limit, Instant now) {
  return stream.counter >= 0 && now - stream.changed <= limit;
}

bool commands_live(const Params& p, const State& s, Instant now) {
  return live(s.brake_kpa, p.command_timeout, now) &&
         live(s.throttle_percent, p.command_timeout, now) &&
         live(s.steering_deg, p.command_timeout, now);
}

void change_system(State& state, const Params& params, const Feedback& f, Instant now) {
  const SystemInputs in{.ct = state.ct_state,
                        .orange = state.orange,
                        .engine_kill = state.engine_kill,
                        .engine_running = f.engine_running,
                        .standstill = std::abs(f.vehicle_speed_mps) < params.standstill_mps};
  const SysState next = next_state(state.system, now - state.system_since, in);
  if (next == state.system) return;
  state.system = next;
  state.system_since = now;
}

void watch(const Params& params, State& state, const Feedback& f, Instant now) {
  const bool engine =
      state.system == SysState::kEngineRunning || state.system == SysState::kDriving;
  const bool may_drive = engine && state.ct_state >= CtState::kInitDriving &&
                         state.ct_state <= CtState::kCoordinatedStop;
  if (may_drive && !state.may_drive) state.driving_since = now;
  state.may_drive = may_drive;
  const bool commands = commands_live(params, state, now);
  const bool ct_live = live(state.ct, params.ct_timeout, now);
  const bool graced = now - state.driving_since <= params.command_timeout;
  if (may_drive && !commands && !graced) state.watchdog = true;
  const bool released = commands || (!may_drive && ct_live);
  if (std::abs(f.vehicle_speed_mps) < params.standstill_mps && released) state.watchdog = false;
  state.diagnostics.computer_heartbeat_lost = state.watchdog || (state.ct.counter >= 0 && !ct_live);
  state.diagnostics.emergency_brake =
      state.watchdog || state.system == SysState::kEmergencyShutdown;
  state.diagnostics.race_control_lost = now - state.race_received > params.race_control_timeout;
}

double approach(double from, double to, double step_max) {
  return from + std::clamp(to - from, -step_max, step_max);
}

// What the actuators are asked for; the rules are in the header.
void demand(const Params& params, State& state, const Feedback& f, Instant now) {
  const double dt_s = (now - state.last_step).seconds();
  const bool shutting =
      state.system == SysState::kShutEngine || state.system == SysState::kEmergencyShutdown;
  const bool shut_steered = shutting && state.ct_state >= CtState::kInitDriving &&
                            state.ct_state <= CtState::kEmergencyShutdown;
  const bool driven = state.may_drive && !state.watchdog;
  const auto follows = [&](const CommandStream& s) {
    const bool alive = live(s, params.command_timeout, now);
    return !state.watchdog && s.counter >= 0 && (state.may_drive || (shut_steered && alive));
  };

  Demand& d = state.demand;
  if (follows(state.steering_deg)) d.steering_motor_rad = from_deg(state.steering_deg.value);
  const double percent =
      driven && state.throttle_percent.counter >= 0 ? state.throttle_percent.value : 0.0;
  d.throttle_fraction = std::clamp(percent / 100.0, 0.0, 1.0);
  if (driven) d.gear = state.gear;
  if (!driven && !state.watchdog) d.gear = 0;

  const double ramp_kpa = params.brake_ramp_kpa_per_s * dt_s;
  const bool emergency = state.watchdog || state.system == SysState::kEmergencyShutdown;
  const double aim_kpa = emergency ? params.emergency_brake_kpa : params.standby_brake_kpa;
  const double own_kpa = approach(d.brake_front_kpa, aim_kpa, ramp_kpa);
  const double asked_kpa = std::clamp(state.brake_kpa.value, 0.0, params.brake_max_kpa);
  const bool brakes_follow = follows(state.brake_kpa);
  d.brake_front_kpa = !brakes_follow ? own_kpa
                      : emergency    ? std::max(own_kpa, asked_kpa)
                                     : asked_kpa;
  d.brake_rear_kpa = params.rear_brake_ratio * d.brake_front_kpa;

  const bool cranking = state.system == SysState::kCranking;
  d.crank = cranking && !f.engine_running;
  d.engine_on = (cranking && now - state.system_since >= params.starter_time) ||
                state.system == SysState::kEngineRunning || state.system == SysState::kDriving;
}

void act(State& state, Instant now) {
  const double dt_s = (now - state.last_step).seconds();
  const ActuatorFaults& faults = state.faults;
  const Demand before = state.acted;
  state.acted = state.demand;
  state.acted.steering_motor_rad += faults.steering_bias_rad;
  if (faults.steering_rate_rad_per_s > 0.0)
    state.acted.steering_motor_rad =
        approach(before.steering_motor_rad, state.acted.steering_motor_rad,
                 faults.steering_rate_rad_per_s * dt_s);
  if (faults.steering_stuck) state.acted.steering_motor_rad = before.steering_motor_rad;
  if (faults.throttle_stuck) state.acted.throttle_fraction = before.throttle_fraction;
  const double kept = 1.0 - std::clamp(faults.brake_leak, 0.0, 1.0);
  state.acted.brake_front_kpa *= kept;
  state.acted.brake_rear_kpa *= kept;
  if (std::isfinite(faults.brake_stuck_kpa))
    state.acted.brake_front_kpa = state.acted.brake_rear_kpa = faults.brake_stuck_kpa;
}

// True when the difference has been too large for too long; NaN is too large.
bool out_of_tolerance(double error, double tolerance, Duration limit, Instant now, Instant& good) {
  if (std::abs(error) <= tolerance) good = now;
  return now - good > limit;
}

void diagnose(const Params& p, State& s, const Feedback& f, Instant now) {
  Diagnostics& d = s.diagnostics;
  d.front_brake_out_of_spec =
      out_of_tolerance(f.brake_front_kpa - s.demand.brake_front_kpa, p.brake_tolerance_kpa,
                       p.tolerance_time, now, s.front_in_tolerance);
  d.rear_brake_out_of_spec =
      out_of_tolerance(f.brake_rear_kpa - s.demand.brake_rear_kpa, p.brake_tolerance_kpa,
                       p.tolerance_time, now, s.rear_in_tolerance);
  d.steer_warning =
      out_of_tolerance(f.steering_motor_rad - s.demand.steering_motor_rad, p.steering_tolerance_rad,
                       p.tolerance_time, now, s.steering_in_tolerance);
  d.low_engine_speed = f.engine_running && f.engine_speed_rpm < p.low_engine_rpm;
}

}  // namespace

Output step(const Params& params, State& state, std::span<const can::ReceivedFrame> incoming,
            const Feedback& feedback, Instant now) {
  if (!state.begun) begin(params, state, now);
  for (const can::ReceivedFrame& received : incoming) receive(params, state, received.frame, now);
  change_system(state, params, feedback, now);
  watch(params, state, feedback, now);
  demand(params, state, feedback, now);
  act(state, now);
  // The steering sensor sits before the bias: it shows what was asked for.
  Feedback sensed = feedback;
  sensed.steering_motor_rad -= state.faults.steering_bias_rad;
  diagnose(params, state, sensed, now);
  const ReportInputs reported{.feedback = sensed,
                              .diagnostics = state.diagnostics,
                              .system = state.system,
                              .engine_switch = state.demand.engine_on,
                              .misc_period = params.misc_report_period};

  Output out{.frames = due_reports(state.reports, reported, now),
             .demand = state.acted,
             .system = state.system,
             .watchdog = state.watchdog};
  state.counters.skipped = state.reports.skipped;
  state.counters.unsent = state.reports.unsent;
  state.counters.saturated = state.reports.saturated;
  state.last_step = now;
  return out;
}

}  // namespace pitwall::drive_by_wire
