// SPDX-License-Identifier: Apache-2.0
#include "vehicle/guardian/guardian.hpp"

#include <algorithm>
#include <cmath>

#include "vehicle/safety/fault_detection.hpp"

namespace pitwall::guardian {
namespace {

namespace av21 = can::av21;

constexpr double kMpsPerKmh = 1.0 / 3.6;
constexpr double kWheelMax_mps = 120.0;
constexpr Duration kSignalAgeMax = milliseconds(100);
constexpr Duration kFreshRecord = milliseconds(25);
// Later than this after its last tick, the guardian itself did not run.
constexpr Duration kPauseMin = milliseconds(10);
// A tick of the car that began before it could read that the guardian drives is over by then.
constexpr Duration kSendOverlapMax = milliseconds(20);
const world::SensorInput kNoSamples;

struct Tick {
  const Params& params;
  State& state;
  const Inputs& in;
  bool new_record = false, command_received = false;
};

void enter(const Tick& t, Mode mode, Cause cause) {
  Status& status = t.state.status;
  status.mode = mode;
  status.cause = cause;
  status.since = t.in.now;
}

bool is_moving(world::Mode mode) {
  return mode == world::Mode::kDriving || mode == world::Mode::kCoast ||
         mode == world::Mode::kControlledStop || mode == world::Mode::kEmergencyStop;
}

bool guarded(const CarRecord& record) { return record.armed && is_moving(record.mode); }

void receive_wheel_speeds(State& s, const can::ReceivedFrame& received) {
  av21::WheelSpeedReport m;
  if (!av21::decode(received.frame, m)) return;
  const world::PerWheel wheels{{m.wheel_speed_FL * kMpsPerKmh, m.wheel_speed_FR * kMpsPerKmh,
                                m.wheel_speed_RL * kMpsPerKmh, m.wheel_speed_RR * kMpsPerKmh}};
  for (const double v_mps : wheels.at)
    if (v_mps > kWheelMax_mps) return;
  s.signals.wheel_speed_before_mps = s.signals.wheel_speed_mps;
  s.signals.wheel_speed_mps = {wheels, received.at, true};
}

void receive_steering(State& s, const can::ReceivedFrame& received) {
  av21::SteeringReport m;
  if (!av21::decode(received.frame, m)) return;
  s.signals.steering_motor_rad = {from_deg(m.steering_motor_ang_avg_fdbk), received.at, true};
}

void receive_brake(State& s, const can::ReceivedFrame& received) {
  av21::BrakePressureReport m;
  if (!av21::decode(received.frame, m)) return;
  s.signals.brake = {{m.brake_pressure_fdbk_front, m.brake_pressure_fdbk_rear}, received.at, true};
}

void receive_frames(Tick& t) {
  State& s = t.state;
  for (const can::ReceivedFrame& received : t.in.can) {
    const std::uint32_t id = received.frame.id;
    if (id >= av21::BrakePressureCmd::kId && id <= av21::CtVehicleAccFeedback::kId) {
      t.command_received |= receive(s.received, received);
      continue;
    }
    s.others_at = std::max(s.others_at, received.at);
    if (id == av21::WheelSpeedReport::kId) receive_wheel_speeds(s, received);
    if (id == av21::SteeringReport::kId) receive_steering(s, received);
    if (id == av21::BrakePressureReport::kId) receive_brake(s, received);
  }
}

void judge_front_wheels(const Tick& t) {
  State& s = t.state;
  const double lock_slip = t.params.following.stop.lock_slip;
  s.front_slip = safety::front_slip(
      s.front_wheels, safety::front_wheels_of(s.signals, lock_slip, kUnset, t.in.now));
}

// While the guardian itself did not run it cannot know who else did not: what stops a whole machine
// for a moment is no silence of the car's process.
void count_silence(const Tick& t) {
  State& s = t.state;
  if (t.command_received) s.silent_from = s.received.commanded_at;
  const Duration pause = t.in.now - s.stepped_at;
  if (s.stepped_at != Instant{} && pause > kPauseMin)
    s.silent_from = std::min(t.in.now - kTick, s.silent_from + (pause - kTick));
  s.stepped_at = t.in.now;
}

void take_record(Tick& t) {
  State& s = t.state;
  if (!t.in.record) return;
  const CarRecord& record = *t.in.record;
  if (record.run == s.record.run && record.sequence == s.record.sequence) return;
  t.new_record = true;
  // The stop that is being driven stays; whether the car process lives is read anew.
  const CarRecord before = s.record;
  s.record = record;
  if (!drives(s.status.mode)) return;
  s.record.stop = before.stop;
  s.record.datum = before.datum;
}

void store_accelerations(Tick& t) {
  for (const world::ImuSample& sample : t.in.sensors.imu) {
    t.state.ax_mps2 = sample.specific_force_mps2[0];
    t.state.ay_mps2 = sample.specific_force_mps2[1];
  }
}

double wheel_speed(const Tick& t) {
  return safety::wheel_speed_mps(t.state.signals, t.in.now, kSignalAgeMax);
}

// Without wheels the speed is what the brake leaves of it.
double speed(const Tick& t) {
  const State& s = t.state;
  const double by_wheels = wheel_speed(t);
  if (std::isfinite(by_wheels)) return by_wheels;
  const double decel_mps2 =
      s.following.command.brake_kpa / t.params.following.stop.brake_kpa_per_mps2;
  const double lost_mps = decel_mps2 * (t.in.now - s.reckoning.pose.at).seconds();
  return std::isfinite(lost_mps) ? std::max(0.0, s.reckoning.pose.speed_mps - lost_mps) : kUnset;
}

Motion motion_of(const Tick& t) {
  const auto& steering = t.state.signals.steering_motor_rad;
  return {.speed_mps = speed(t),
          .steering_motor_rad = steering.fresh(t.in.now, kSignalAgeMax) ? steering.value : kUnset};
}

void reckon(const Tick& t, const world::SensorInput& sensors) {
  State& s = t.state;
  reckon(t.params.reckoning, s.reckoning, motion_of(t), sensors, s.record.datum,
         s.following.bank_rad, t.in.now);
}

safety::PathPose on_path(const Pose& pose) {
  return {.x_m = pose.x_m,
          .y_m = pose.y_m,
          .yaw_rad = pose.yaw_rad,
          .speed_mps = pose.speed_mps,
          .slip_mps = pose.slip_mps,
          .yaw_rate_rad_per_s = pose.yaw_rate_rad_per_s};
}

// Why it must not or cannot act; kNone: it can.
Cause takeover_obstacle(Tick& t) {
  State& s = t.state;
  if (t.in.now - s.others_at > t.params.bus_silence_max) return Cause::kBusSilent;
  if (s.received.commanded_at - s.record.at > kRecordLag) return Cause::kStale;
  if (s.record.stop.points.size() < 2 || !s.received.complete()) return Cause::kNoPath;
  if (!s.reckoning.begun) return Cause::kOffPath;
  s.following = {};
  safety::locate(s.following, s.record.stop, on_path(s.reckoning.pose));
  reckon(t, kNoSamples);  // taken once, by drive()
  safety::locate(s.following, s.record.stop, on_path(s.reckoning.pose));
  return std::abs(s.following.lateral_m) <= t.params.off_path_max_m ? Cause::kNone
                                                                    : Cause::kOffPath;
}

safety::GateContext gate_context(const Tick& t, world::Mode mode, Instant command_at, Instant now) {
  return {.mode = mode,
          .armed = true,
          .speed_mps = wheel_speed(t),
          .command_at = command_at,
          .now = now};
}

// The gate needs the last command of the car: it then judges our first frames by it.
void seed_gate(const Tick& t) {
  State& s = t.state;
  s.gate = {};
  const CommandFrames last = repeat(s.received);
  const Instant at = s.received.commanded_at;
  (void)safety::gate(t.params.gate, s.gate, gate_context(t, world::Mode::kDriving, at, at),
                     last.span());
  s.gate.verdicts = {};
}

void take_over(const Tick& t) {
  State& s = t.state;
  enter(t, Mode::kDriving, Cause::kCarSilent);
  s.following.command = command_of(s.received, t.params.reckoning.steering_ratio);
  s.following.learned = s.reckoning.learned = s.record.learned;
  s.following.tyre_c = s.record.tyre_c;
  s.open_loop = {};
  s.standing = false;
  s.fresh_records = 0;
  s.next_send = t.in.now;
  s.status.run = s.record.run;
  s.status.drove_from = s.status.drove_until = t.in.now;
  s.status.counters = counters_of(s.received);
  s.status.latched = s.handed_back && t.in.now - s.handed_back_at < t.params.hand_back_again;
  ++s.status.takeovers;
  seed_gate(t);
}

void watch(Tick& t) {
  State& s = t.state;
  if (t.new_record) follow_car(t.params.reckoning, s.reckoning, s.record.ego);
  if (!guarded(s.record)) {
    if (s.status.mode != Mode::kIdle) enter(t, Mode::kIdle, Cause::kNone);
    return;
  }
  const bool incoming =
      s.status.mode == Mode::kHandedBack ? t.command_received : s.received.commanded;
  if (t.in.now - s.silent_from < kSilence) {
    if (s.status.mode != Mode::kWatching && incoming) enter(t, Mode::kWatching, Cause::kNone);
    return;
  }
  if (!s.received.commanded) return;
  const Cause cause = takeover_obstacle(t);
  if (cause == Cause::kNone) return take_over(t);
  if (s.status.mode != Mode::kNothingToDrive || s.status.cause != cause)
    enter(t, Mode::kNothingToDrive, cause);
}

void hand_back(const Tick& t, Cause cause) {
  State& s = t.state;
  s.handed_back = true;
  s.handed_back_at = t.in.now;
  ++s.status.hand_backs;
  s.received.commanded_at = s.silent_from = t.in.now;  // the full silence is allowed again
  s.status.guidance = Guidance::kNone;
  enter(t, Mode::kHandedBack, cause);
}

void count_records(const Tick& t) {
  State& s = t.state;
  const bool fresh = t.in.now - s.record.at <= kFreshRecord;
  if (!fresh) s.fresh_records = 0;
  if (fresh && t.new_record) ++s.fresh_records;
}

// The hold at standstill ends: reset by the operator of this run, or a new one that is not armed.
bool is_released(const Tick& t, bool alive) {
  const State& s = t.state;
  const bool other_run = s.record.run != s.status.run;
  return s.status.mode == Mode::kHalted && alive && s.record.reset &&
         (!other_run || !s.record.armed);
}

// Whether the car process gets the car again; true if it did.
bool try_hand_back(const Tick& t) {
  State& s = t.state;
  const CarRecord& record = s.record;
  count_records(t);
  const bool alive = s.fresh_records >= kRecordsToBelieve;
  if (record.sends && s.fresh_records > 0 && record.at - s.status.drove_from > kSendOverlapMax) {
    hand_back(t, Cause::kCarSends);
    return true;
  }
  if (is_released(t, alive)) {
    s.status.latched = false;
    hand_back(t, Cause::kReset);
    return true;
  }
  if (t.in.now - s.status.drove_from > kHandBackLimit) s.status.latched = true;
  if (s.status.latched || !alive || record.run != s.status.run || !guarded(record)) return false;
  hand_back(t, Cause::kCarBack);
  return true;
}

Guidance guidance_of(const Tick& t) {
  const State& s = t.state;
  const bool placed =
      s.reckoning.positioned && t.in.now - s.reckoning.position_at <= t.params.position_age_max;
  if (placed) return Guidance::kPosition;
  return s.reckoning.gyro_used ? Guidance::kInertial : Guidance::kOpenLoop;
}

// Open loop from where feedback ended, and again if it comes back and ends anew.
world::ActuatorCommand open_loop(const Tick& t) {
  State& s = t.state;
  const safety::SafeStopInputs in{.stop = s.record.stop,
                                  .last_good = s.following.command,
                                  .speed_mps = wheel_speed(t),
                                  .tyre_c = s.record.tyre_c,
                                  .slip = {.front = s.front_slip},
                                  .learned = s.record.learned};
  return safety::stop_along(t.params.following, s.open_loop, in, t.in.now);
}

world::ActuatorCommand next_command(const Tick& t) {
  State& s = t.state;
  s.status.guidance = guidance_of(t);
  if (s.status.guidance != Guidance::kOpenLoop) {
    s.open_loop = {};
    safety::PathPose pose = on_path(s.reckoning.pose);
    pose.slip.front = s.front_slip;
    return safety::follow_stop(t.params.following, s.following, s.record.stop, pose,
                               safety::StopKind::kControlled, t.in.now);
  }
  s.following.command = open_loop(t);
  s.following.last = t.in.now;  // where feedback comes back, it turns the wheels from here
  return s.following.command;
}

void detect_standstill(const Tick& t) {
  State& s = t.state;
  const bool still = s.reckoning.pose.speed_mps < t.params.following.stop.standstill_mps;
  if (still && !s.standing) s.standing_since = t.in.now;
  s.standing = still;
  const bool dwelt = still && t.in.now - s.standing_since >= t.params.standstill_dwell;
  if (s.status.mode != Mode::kDriving || !dwelt) return;
  s.status.latched = true;
  enter(t, Mode::kHalted, Cause::kStands);
}

void drive(const Tick& t, Output& out) {
  State& s = t.state;
  if (try_hand_back(t)) return;
  s.status.drove_until = t.in.now;
  reckon(t, t.in.sensors);
  detect_standstill(t);
  if (t.in.now < s.next_send) return;
  s.next_send = t.in.now + kSendPeriod;
  s.status.command = next_command(t);
  const CommandFrames encoded = encode_frames(s.received, s.status.counters,
                                              {.command = s.status.command,
                                               .steering_ratio = t.params.reckoning.steering_ratio,
                                               .ax_mps2 = s.ax_mps2,
                                               .ay_mps2 = s.ay_mps2});
  const auto passed = safety::gate(
      t.params.gate, s.gate,
      gate_context(t, world::Mode::kControlledStop, s.status.command.at, t.in.now), encoded.span());
  out.frames = passed.frames;
  out.gate_refusals = passed.refused_total;
}

}  // namespace

Output step(const Params& params, State& state, const Inputs& inputs) {
  Tick tick{params, state, inputs};
  Output out;
  const Mode before = state.status.mode;
  receive_frames(tick);
  judge_front_wheels(tick);
  count_silence(tick);
  store_accelerations(tick);
  store_gyro_rates(state.reckoning, inputs.sensors);
  take_record(tick);
  if (!drives(before)) watch(tick);
  if (drives(state.status.mode)) drive(tick, out);
  state.status.at = inputs.now;
  out.mode_changed = state.status.mode != before;
  return out;
}

}  // namespace pitwall::guardian
