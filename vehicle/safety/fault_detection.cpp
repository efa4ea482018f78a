// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/fault_detection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pitwall::safety {
namespace {

using world::SysState;
using world::Validity;
using world::VehicleFlag;

constexpr auto kFirstOfDriveByWire = static_cast<std::size_t>(Stream::kWheelSpeed);
constexpr auto kLastOfDriveByWire = static_cast<std::size_t>(Stream::kDiagnostics);

struct Finder {
  const FaultParams& params;
  const FaultInputs& in;
  FaultOutput out;

  void add(Cause cause, bool holds, double value) {
    if (!holds) return;
    out.causes.add(cause);
    out.values[static_cast<std::size_t>(cause)] = value;
  }
  void add(Cause cause, bool holds) { add(cause, holds, 1.0); }
};

bool is_down(const StreamRow& row) {
  return row.health == Health::kNever || row.health == Health::kBad;
}

// Both of a pair are down; a unit that is not watched has no say.
bool both_down(const WatchdogOutput& dog, Stream a, Stream b) {
  const bool none = dog[a].health == Health::kUnwatched && dog[b].health == Health::kUnwatched;
  const auto up = [&](Stream s) { return dog[s].health != Health::kUnwatched && !is_down(dog[s]); };
  return !none && !up(a) && !up(b);
}

double age_s(const WatchdogOutput& dog, Stream a, Stream b) {
  return std::min(dog[a].age, dog[b].age).seconds();
}

void operators(Finder& f) {
  f.add(Cause::kOperatorEmergency, f.in.operator_requests.emergency_stop);
  f.add(Cause::kOperatorStop, f.in.operator_requests.stop);
  f.add(Cause::kDisarmRequest, f.in.driving && !f.in.operator_requests.arm);
  f.add(Cause::kPurpleFlag, f.in.race_control.vehicle == VehicleFlag::kPurpleEmergency);
  f.add(Cause::kEngineKillFlag, f.in.race_control.vehicle == VehicleFlag::kEngineKill);
}

void drive_by_wire(Finder& f) {
  const auto& misc = f.in.signals.misc;
  if (misc.heard) {
    const SysState sys = misc.value.sys_state;
    const auto value = static_cast<double>(sys);
    f.add(Cause::kSysEmergencyShutdown, sys == SysState::kEmergencyShutdown, value);
    f.add(Cause::kCriticalLimits, sys == SysState::kCriticalLimitsExceeded, value);
  }
  if (!f.in.signals.diagnostics.heard) return;
  const auto& d = f.in.signals.diagnostics.value;
  f.add(Cause::kSystemFailure, d.system_failure);
  f.add(Cause::kEmergencyBrake, d.emergency_brake);
  f.add(Cause::kSteeringCommsLost, d.steer_comms_lost);
  f.add(Cause::kMotecCommsLost, d.motec_comms_lost);
  f.add(Cause::kBrakeOutOfSpec, d.front_brake_out_of_spec || d.rear_brake_out_of_spec);
  f.add(Cause::kComputerHeartbeatLost, d.computer_heartbeat_lost);
  f.add(Cause::kRaceControlReportedLost, d.race_control_lost);
}

void bus(Finder& f) {
  // While listening the bus is not known, and not knowing bars arming as well. Value: the first id
  // that differs.
  f.add(Cause::kWrongBus, f.in.bus.identity.verdict != world::IdentityVerdict::kRight,
        static_cast<double>(f.in.bus.identity.id));
  f.add(Cause::kBusOff, f.in.bus_failed);
  f.add(Cause::kOwnIdOnBus, f.in.own_id_seen);
  // Value: which stream.
  for (std::size_t s = kFirstOfDriveByWire; s <= kLastOfDriveByWire; ++s)
    f.add(Cause::kBusMessageLost, is_down(f.in.watchdog.rows[s]), static_cast<double>(s));
}

// Since the newest message of the drive-by-wire; none before the first.
std::optional<Duration> drive_by_wire_silence(const WatchdogOutput& dog) {
  std::optional<Duration> least;
  for (std::size_t s = kFirstOfDriveByWire; s <= kLastOfDriveByWire; ++s) {
    const StreamRow& row = dog.rows[s];
    if (row.health == Health::kUnwatched || row.health == Health::kNever) continue;
    least = std::min(least.value_or(row.age), row.age);
  }
  return least;
}

void dead_bus(Finder& f, FaultState& state, Instant now) {
  const auto silence = drive_by_wire_silence(f.in.watchdog);
  const bool dead = silence && *silence > f.params.bus_dead;
  if (dead && !state.bus_dead) state.bus_dead_since = now;
  state.bus_dead = dead;
  f.add(Cause::kBusDead, dead, silence ? silence->seconds() : kUnset);
  f.out.nobody_obeys = dead && now - state.bus_dead_since >= f.params.bus_dead_disarm;
}

void counts(Finder& f, FaultState& state) {
  const auto run = [](std::uint8_t& ticks, bool bad, std::uint8_t limit) {
    ticks = bad ? static_cast<std::uint8_t>(std::min<int>(ticks + 1, limit)) : std::uint8_t{0};
    return ticks >= limit;
  };
  const bool failed =
      run(state.control_failed_ticks, f.in.driving && !f.in.control_ok, f.params.control_failures);
  const bool refused = run(state.gate_refused_ticks, f.in.gate_refused, f.params.refused_ticks);
  f.add(Cause::kControlFailed, failed, state.control_failed_ticks);
  f.add(Cause::kCommandRefused, refused, state.gate_refused_ticks);
}

void localization(Finder& f, FaultState& state, Instant now) {
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
  // Not a number is uncertain.
  f.add(Cause::kLocalizationUncertain, !(ego.position_sigma_m <= f.params.position_sigma_max_m),
        ego.position_sigma_m);
}

void streams(Finder& f) {
  const WatchdogOutput& dog = f.in.watchdog;
  const auto down = [&](Cause cause, Stream s) {
    f.add(cause, is_down(dog[s]), dog[s].age.seconds());
  };
  const auto pair = [&](Cause cause, Stream a, Stream b) {
    f.add(cause, both_down(dog, a, b), age_s(dog, a, b));
  };
  down(Cause::kPlanLost, Stream::kPlanner);
  down(Cause::kGnssUnitDisconnected, Stream::kGnss0Link);
  down(Cause::kGnssUnitDisconnected, Stream::kGnss1Link);
  pair(Cause::kGnssRateLost, Stream::kGnss0Position, Stream::kGnss1Position);
  pair(Cause::kGnssSolutionLost, Stream::kGnss0Solution, Stream::kGnss1Solution);
  pair(Cause::kImuLost, Stream::kImu0, Stream::kImu1);
  if (f.params.race_control_required) down(Cause::kRaceControlLost, Stream::kRaceControl);
  if (f.params.radio_loss_stops)
    f.add(Cause::kRadioLost, f.in.radio_stop || is_down(dog[Stream::kRadio]),
          dog[Stream::kRadio].age.seconds());
}

}  // namespace

FaultOutput detect(const FaultParams& params, FaultState& state, const FaultInputs& inputs,
                   Instant now) {
  Finder finder{params, inputs, {}};
  operators(finder);
  drive_by_wire(finder);
  bus(finder);
  dead_bus(finder, state, now);
  counts(finder, state);
  localization(finder, state, now);
  streams(finder);
  return finder.out;
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
