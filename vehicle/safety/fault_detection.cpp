// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/fault_detection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pitwall::safety {
namespace {

using world::Monitor;
using world::SysState;
using world::Validity;
using world::VehicleFlag;

constexpr auto kFirstOfDriveByWire = static_cast<std::size_t>(Stream::kWheelSpeed);
constexpr auto kLastOfDriveByWire = static_cast<std::size_t>(Stream::kDiagnostics);

struct CauseCollector {
  const FaultParams& params;
  const FaultInputs& in;
  FaultOutput out;

  bool is_off(Monitor monitor) const { return params.off.has(monitor); }
  void add(Cause cause, bool holds, double value) {
    if (!holds) return;
    out.causes.add(cause);
    out.values[static_cast<std::size_t>(cause)] = value;
  }
  void add(Cause cause, bool holds) { add(cause, holds, 1.0); }
  // What this monitor found.
  void add(Monitor monitor, Cause cause, bool holds, double value) {
    if (is_off(monitor)) return;
    add(cause, holds, value);
    see(monitor, holds);
  }
  void see(Monitor monitor, bool holds) {
    if (holds && !is_off(monitor)) out.seen.add(monitor);
  }
};

bool is_down(const StreamRow& row) {
  return row.health == Health::kNever || row.health == Health::kBad;
}

// Both of a pair are down; a unit that is not watched has no say.
bool both_down(const WatchdogOutput& watchdog, Stream a, Stream b) {
  const bool none =
      watchdog[a].health == Health::kUnwatched && watchdog[b].health == Health::kUnwatched;
  const auto up = [&](Stream s) {
    return watchdog[s].health != Health::kUnwatched && !is_down(watchdog[s]);
  };
  return !none && !up(a) && !up(b);
}

double age_s(const WatchdogOutput& watchdog, Stream a, Stream b) {
  return std::min(watchdog[a].age, watchdog[b].age).seconds();
}

void operators(CauseCollector& f) {
  f.add(Cause::kOperatorEmergency, f.in.operator_requests.emergency_stop);
  f.add(Cause::kOperatorStop, f.in.operator_requests.stop);
  f.add(Cause::kDisarmRequest, f.in.driving && !f.in.operator_requests.arm);
  const world::FlagDemand flag = demand_of(f.in.race_control.vehicle);
  f.add(Cause::kPurpleFlag, flag == world::FlagDemand::kEmergencyStop);
  f.add(Cause::kEngineKillFlag, flag == world::FlagDemand::kControlledStop);
}

void drive_by_wire(CauseCollector& f) {
  const auto& misc = f.in.signals.misc;
  if (misc.received) {
    const SysState sys = misc.value.sys_state;
    const auto value = static_cast<double>(sys);
    f.add(Cause::kSysEmergencyShutdown, sys == SysState::kEmergencyShutdown && !f.in.engine_off,
          value);
    f.add(Cause::kCriticalLimits, sys == SysState::kCriticalLimitsExceeded, value);
  }
  if (!f.in.signals.diagnostics.received) return;
  const auto& d = f.in.signals.diagnostics.value;
  f.add(Cause::kSystemFailure, d.system_failure);
  f.add(Cause::kEmergencyBrake, d.emergency_brake && !f.in.engine_off);
  f.add(Cause::kSteeringCommsLost, d.steer_comms_lost);
  f.add(Cause::kMotecCommsLost, d.motec_comms_lost);
  f.add(Cause::kBrakeOutOfSpec, d.front_brake_out_of_spec || d.rear_brake_out_of_spec);
  f.add(Cause::kComputerHeartbeatLost, d.computer_heartbeat_lost);
  f.add(Monitor::kRaceControl, Cause::kRaceControlReportedLost, d.race_control_lost, 1.0);
}

void bus(CauseCollector& f) {
  // While listening the bus is not known, and not knowing bars arming as well. Value: the first id
  // that differs.
  f.add(Cause::kWrongBus, f.in.bus.identity.verdict != world::IdentityVerdict::kRight,
        static_cast<double>(f.in.bus.identity.id));
  f.add(Cause::kBusOff, f.in.bus_failed);
  f.add(Cause::kOwnIdOnBus, f.in.own_id_seen);
  // Value: which stream.
  for (std::size_t s = kFirstOfDriveByWire; s <= kLastOfDriveByWire; ++s)
    f.add(Monitor::kMessageAge, Cause::kBusMessageLost, is_down(f.in.watchdog.rows[s]),
          static_cast<double>(s));
}

// Since the newest message of the drive-by-wire; none before the first.
std::optional<Duration> drive_by_wire_silence(const WatchdogOutput& watchdog) {
  std::optional<Duration> least;
  for (std::size_t s = kFirstOfDriveByWire; s <= kLastOfDriveByWire; ++s) {
    const StreamRow& row = watchdog.rows[s];
    if (row.health == Health::kUnwatched || row.health == Health::kNever) continue;
    least = std::min(least.value_or(row.age), row.age);
  }
  return least;
}

void dead_bus(CauseCollector& f, FaultState& state, Instant now) {
  const auto silence = drive_by_wire_silence(f.in.watchdog);
  const bool dead = silence && *silence > f.params.bus_dead && !f.is_off(Monitor::kMessageAge);
  if (dead && !state.bus_dead) state.bus_dead_since = now;
  state.bus_dead = dead;
  f.add(Monitor::kMessageAge, Cause::kBusDead, dead, silence ? silence->seconds() : kUnset);
  f.out.drive_by_wire_gone = dead && now - state.bus_dead_since >= f.params.bus_dead_disarm;
}

void counts(CauseCollector& f, FaultState& state) {
  const auto run = [](std::uint8_t& ticks, bool bad, std::uint8_t limit) {
    ticks = bad ? static_cast<std::uint8_t>(std::min<int>(ticks + 1, limit)) : std::uint8_t{0};
    return ticks >= limit;
  };
  const bool failed =
      run(state.control_failed_ticks, f.in.driving && !f.in.control_ok, f.params.control_failures);
  const bool refused = run(state.gate_refused_ticks, f.in.gate_refused, f.params.refused_ticks);
  const std::uint8_t missing = state.control_failed_ticks;
  f.add(Monitor::kModule, Cause::kControlFailed, failed, missing);
  f.add(Monitor::kModule, Cause::kControlLate, missing > 0 && !failed, missing);
  f.add(Cause::kCommandRefused, refused, state.gate_refused_ticks);
}

void localization(CauseCollector& f, FaultState& state, Instant now) {
  const world::EgoState& ego = f.in.ego;
  if (ego.validity == Validity::kGood) {
    state.last_good = now;
    state.positioned = true;
  }
  const bool lost = ego.validity == Validity::kNever || ego.validity == Validity::kLost;
  f.add(Cause::kLocalizationLost, lost, static_cast<double>(ego.validity));
  if (lost) return;
  const Duration blind = now - state.last_good;
  f.add(Cause::kDeadReckoningTooLong, !state.positioned || blind > f.params.dead_reckoning_max,
        state.positioned ? blind.seconds() : kUnset);
  const bool passing = state.positioned && blind > f.params.dead_reckoning_coast;
  f.add(Cause::kPositionPassing, passing, blind.seconds());
  // Not a number is uncertain.
  f.add(Cause::kLocalizationUncertain, !(ego.position_sigma_m <= f.params.position_sigma_max_m),
        ego.position_sigma_m);
}

// What is left of a receiver for localization.
struct ReceiverState {
  bool watched = false, silent = false, unsolved = false, uncertain = false;
  bool is_good() const { return watched && !silent && !unsolved && !uncertain; }
};
ReceiverState receiver(const CauseCollector& f, std::size_t unit) {
  constexpr std::array kPosition{Stream::kGnss0Position, Stream::kGnss1Position};
  constexpr std::array kSolution{Stream::kGnss0Solution, Stream::kGnss1Solution};
  const WatchdogOutput& watchdog = f.in.watchdog;
  ReceiverState out{.watched = watchdog[kPosition[unit]].health != Health::kUnwatched};
  out.silent = out.watched && is_down(watchdog[kPosition[unit]]);
  out.unsolved = out.watched && is_down(watchdog[kSolution[unit]]);
  out.uncertain =
      out.watched && watchdog.sigma_m[unit] > f.params.gnss_sigma_max_m;  // unset: false
  return out;
}

// The paper's rules; where each unit is lost in its own way, each way is a cause.
void gnss(CauseCollector& f) {
  const WatchdogOutput& watchdog = f.in.watchdog;
  const ReceiverState a = receiver(f, 0), b = receiver(f, 1);
  const bool has_any = a.watched || b.watched;
  const bool none_good = has_any && !a.is_good() && !b.is_good();
  bool linked = true;
  for (const Stream link : {Stream::kGnss0Link, Stream::kGnss1Link}) {
    linked = linked && !is_down(watchdog[link]);
    f.add(Monitor::kStreamAge, Cause::kGnssUnitDisconnected, is_down(watchdog[link]),
          watchdog[link].age.seconds());
  }
  f.add(Monitor::kStreamAge, Cause::kGnssRateLost,
        both_down(watchdog, Stream::kGnss0Position, Stream::kGnss1Position),
        age_s(watchdog, Stream::kGnss0Position, Stream::kGnss1Position));
  f.add(Monitor::kSolution, Cause::kGnssSolutionLost, none_good && (a.unsolved || b.unsolved),
        age_s(watchdog, Stream::kGnss0Solution, Stream::kGnss1Solution));
  f.add(Monitor::kSolution, Cause::kGnssRtkLost, none_good && (a.uncertain || b.uncertain),
        std::fmin(watchdog.sigma_m[0], watchdog.sigma_m[1]));
  f.add(Monitor::kStreamAge, Cause::kImuLost, both_down(watchdog, Stream::kImu0, Stream::kImu1),
        age_s(watchdog, Stream::kImu0, Stream::kImu1));
  const bool one_bad = has_any && ((a.watched && !a.is_good()) || (b.watched && !b.is_good()));
  f.add(Monitor::kStreamAge, Cause::kGnssDegraded, one_bad && !none_good && linked,
        a.is_good() ? 1.0 : 0.0);
}

void streams(CauseCollector& f) {
  const WatchdogOutput& watchdog = f.in.watchdog;
  const auto is_late = [&](Stream s) { return watchdog[s].health == Health::kWarning; };
  const StreamRow& plan = watchdog[Stream::kPlanner];
  f.add(Monitor::kModule, Cause::kPlanLost, is_down(plan), plan.age.seconds());
  f.add(Monitor::kModule, Cause::kPlanLate, is_late(Stream::kPlanner), plan.age.seconds());

  const StreamRow& race = watchdog[Stream::kRaceControl];
  if (f.params.race_control_required)
    f.add(Monitor::kRaceControl, Cause::kRaceControlLost, is_down(race), race.age.seconds());
  f.see(Monitor::kRaceControl, is_late(Stream::kRaceControl));
  if (f.params.radio_loss_stops)
    f.add(Monitor::kRadioLink, Cause::kRadioLost,
          f.in.radio_stop || is_down(watchdog[Stream::kRadio]),
          watchdog[Stream::kRadio].age.seconds());
  f.see(Monitor::kRadioLink, f.in.radio_fades || is_late(Stream::kRadio));
}

void flags(CauseCollector& f) {
  const world::RaceControl& race = f.in.race_control;
  const bool unknown =
      race.track == world::TrackFlag::kUnknown || race.vehicle == VehicleFlag::kUnknown;
  f.add(Monitor::kFlagAgreement, Cause::kFlagsDisagree,
        race.ever_received && (unknown || race.conflict), race.conflict ? 2.0 : 1.0);
  f.add(Monitor::kFlagAgreement, Cause::kRoundSpeedTooHigh, std::isfinite(race.refused_speed_mps),
        race.refused_speed_mps);
}

// While the car rolls and nobody but us tells its actuators what to do.
bool follows_commands(const CauseCollector& f) {
  const auto& misc = f.in.signals.misc;
  const auto& diagnostics = f.in.signals.diagnostics;
  const bool drives = misc.received && misc.value.sys_state == SysState::kDriving;
  const bool brakes_itself = diagnostics.received && (diagnostics.value.emergency_brake ||
                                                      diagnostics.value.computer_heartbeat_lost);
  return f.in.moves && drives && !brakes_itself && f.in.speed_mps > f.params.following.moving_mps;
}

template <class T, class Part>
world::Received<double> part_of(const world::Received<T>& whole, Part part) {
  return {whole.value.*part, whole.at, whole.received};
}

constexpr Duration kYawRateAgeMax = milliseconds(50);
constexpr double kYawRateSmoothing_s = 0.05;

void compare_yaw_rates(YawRateWatch& watch, const world::SensorInput* sensors, Instant now) {
  if (sensors == nullptr) return;
  for (const world::ImuSample& sample : sensors->imu) {
    if (sample.unit >= world::kGnssUnits) continue;
    watch.rate_rad_per_s[sample.unit] = sample.rate_rad_per_s[2];
    watch.at[sample.unit] = now;
  }
  const double apart = watch.rate_rad_per_s[0] - watch.rate_rad_per_s[1];
  const bool both = now - watch.at[0] <= kYawRateAgeMax && now - watch.at[1] <= kYawRateAgeMax;
  const double dt_s = (now - watch.judged).seconds();
  watch.judged = now;
  if (!both || !std::isfinite(apart))
    watch.apart_rad_per_s = 0.0;
  else
    watch.apart_rad_per_s +=
        (1.0 - std::exp(-dt_s / kYawRateSmoothing_s)) * (apart - watch.apart_rad_per_s);
}

// Whether the IMUs differ by as much yaw rate as the steering would have to explain: until one of
// them is excluded, what the car's turning says of its steering is in doubt.
bool yaw_rate_is_disputed(const CauseCollector& f, const YawRateWatch& watch) {
  const double apart_rad = std::abs(watch.apart_rad_per_s) * f.in.wheelbase_m / f.in.speed_mps;
  return apart_rad > f.params.following.unexplained_max_rad;
}

// A rod that is bent or a motor that slips on its shaft turns the wheels elsewhere than its sensor
// says: the car shows it. Where the sensor itself is outside its bounds, that is the finding; front
// wheels that lock explain it too, and so does an IMU that is wrong.
void turning(CauseCollector& f, FaultState& state, Instant now) {
  const ActuatorParams& p = f.params.following;
  const double excess_rad =
      std::abs(f.in.innovation_rad) - f.in.innovation_sigma_rad - p.unexplained_max_rad;
  const bool follows = state.steering.within == now;
  const bool locks = f.out.front_slip > f.in.lock_slip;
  const bool disputed = yaw_rate_is_disputed(f, state.yaw_rates);
  if (!follows || locks || disputed || !(excess_rad > 0.0))
    state.last_explained = now;  // not a number is explained
  f.out.steering_biased =
      now - state.last_explained >= p.steering.persist && !f.is_off(Monitor::kSteeringFollows);
  f.add(Monitor::kSteeringFollows, Cause::kSteeringBiased, f.out.steering_biased,
        excess_rad * f.in.steering_ratio);
}

void actuators(CauseCollector& f, FaultState& state, Instant now) {
  compare_yaw_rates(state.yaw_rates, f.in.sensors, now);
  const ActuatorParams& p = f.params.following;
  const world::VehicleSignals& s = f.in.signals;
  const world::ActuatorCommand& reported = f.in.reported;
  if (!follows_commands(f)) {
    state.steering = state.brake_front = state.brake_rear = state.throttle = {};
    state.last_explained = now;
    return;
  }
  const auto judge = [&](Monitor monitor, Cause cause, const FollowLimits& limits,
                         FollowState& follow, double command,
                         const world::Received<double>& received) {
    const double excess = excess_deviation(limits, follow, command, received, now);
    f.add(monitor, cause, excess > 0.0, excess);
  };
  judge(Monitor::kSteeringFollows, Cause::kSteeringDeviates, p.steering, state.steering,
        reported.road_wheel_rad * f.in.steering_ratio, s.steering_motor_rad);
  turning(f, state, now);
  judge(Monitor::kBrakeFollows, Cause::kBrakeDeviates, p.brake, state.brake_front,
        reported.brake_kpa, part_of(s.brake, &world::BrakePressure::front_kpa));
  judge(Monitor::kBrakeFollows, Cause::kBrakeDeviates, p.brake, state.brake_rear,
        reported.brake_kpa, part_of(s.brake, &world::BrakePressure::rear_kpa));
  judge(Monitor::kThrottleFollows, Cause::kThrottleDeviates, p.throttle, state.throttle,
        reported.throttle_fraction, s.throttle_fraction);
}

void wheels(CauseCollector& f, FaultState& state, Instant now) {
  constexpr double kBrakes_kpa = 50.0;
  if (f.is_off(Monitor::kOversteer)) return;
  const world::VehicleSignals& s = f.in.signals;
  const bool located = f.in.ego.validity == Validity::kGood;
  OversteerInputs in{.wheel_mps = wheel_frames(s, now)};
  if (s.steering_motor_rad.fresh(now, kSlipAgeMax))
    in.road_wheel_rad = s.steering_motor_rad.value / f.in.steering_ratio;
  if (located) in.speed_mps = f.in.ego.vx_mps;
  if (located) in.yaw_rate_rad_per_s = f.in.ego.yaw_rate_rad_per_s;
  const Oversteer found = detect_oversteer(f.params.oversteer, state.oversteer, in);
  f.out.front_slip =
      front_slip(state.front_wheels, front_wheels_of(s, f.in.lock_slip, in.speed_mps, now));
  if (!f.in.moves) return;
  f.out.oversteers = found.any();
  const auto add = [&](Cause cause, bool holds, double value) {
    f.add(Monitor::kOversteer, cause, holds, value);
  };
  add(Cause::kRearSpin, found.rear_spin > 0.0, found.rear_spin);
  add(Cause::kRearLock, found.rear_lock > 0.0, found.rear_lock);
  add(Cause::kYawExcess, found.yaw_excess > 0.0, found.yaw_excess);
  const bool brakes = f.in.reported.brake_kpa > kBrakes_kpa;  // unset: false
  add(Cause::kFrontLock, brakes && f.out.front_slip > f.in.lock_slip, f.out.front_slip);
}

void computer(CauseCollector& f, FaultState& state, Instant now) {
  const world::ComputerHealth& health = f.in.computer;
  const ComputerVerdict v = judge_computer(f.params.computer, state.computer, health, now);
  f.add(Monitor::kTiming, Cause::kTicksMissed, v.missed, v.gap.seconds());
  f.add(Monitor::kTiming, Cause::kComputerLate, v.late, state.computer.late_s);
  f.add(Monitor::kTiming, Cause::kProcessorBusy, v.busy, health.processor_share);
  f.add(Monitor::kTiming, Cause::kComputerMemory, v.full, health.memory_mib);
  f.add(Monitor::kTiming, Cause::kComputerHot, v.hot, health.temperature_c);
}

void clocks(CauseCollector& f, FaultState& state, Instant now) {
  if (f.in.sensors == nullptr) return;
  const ClockOutput v = watch_clock(f.params.clock, state.clock, *f.in.sensors, now);
  f.add(Monitor::kClock, Cause::kClockStepped, v.stepped, v.step_s);
  f.add(Monitor::kClock, Cause::kClockSkewed, v.skewed, v.skew_ppm);
}

}  // namespace

FaultOutput detect(const FaultParams& params, FaultState& state, const FaultInputs& inputs,
                   Instant now) {
  CauseCollector collector{params, inputs, {}};
  operators(collector);
  drive_by_wire(collector);
  bus(collector);
  dead_bus(collector, state, now);
  counts(collector, state);
  localization(collector, state, now);
  gnss(collector);
  streams(collector);
  flags(collector);
  wheels(collector, state, now);
  actuators(collector, state, now);
  computer(collector, state, now);
  clocks(collector, state, now);
  return collector.out;
}

double wheel_speed_mps(const world::VehicleSignals& signals, Instant now, Duration limit) {
  if (!signals.wheel_speed_mps.fresh(now, limit)) return kUnset;
  auto wheels = signals.wheel_speed_mps.value.at;
  for (const double v_mps : wheels)
    if (!std::isfinite(v_mps)) return kUnset;
  std::sort(wheels.begin(), wheels.end());
  return (wheels[1] + wheels[2]) / 2.0;
}

}  // namespace pitwall::safety
