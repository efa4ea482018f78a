// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "protocol/vocabulary/text.hpp"
#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/range_reader.hpp"

namespace pitwall::parameters {
namespace {

using pipeline::CarParams;

gateway::Span read_span(yaml::StrictMap& map, const char* key, double min, double max) {
  const auto pair = map.numbers(key, 2, 2, min, max);
  if (pair[0] >= pair[1]) map.fail(key, "the first number must be smaller than the second");
  return {pair[0], pair[1]};
}

Duration time_s(yaml::StrictMap& map, const char* key, double min, double max) {
  return from_seconds(map.number(key, min, max));
}

void read_inbound(yaml::StrictMap map, gateway::InboundParams& in) {
  const std::string encoding = map.text("flag_encoding");
  if (encoding == "mylaps") {
    in.flag_encoding = world::FlagEncoding::kMyLaps;
  } else if (encoding == "marelli") {
    in.flag_encoding = world::FlagEncoding::kMarelli;
  } else {
    map.fail("flag_encoding", "\"" + encoding + "\" is not one of: mylaps, marelli");
  }
  in.degraded_debt = static_cast<std::uint8_t>(map.integer("degraded_debt", 1, 100));
  in.fault_debt = static_cast<std::uint8_t>(map.integer("fault_debt", 2, 100));
  if (in.degraded_debt >= in.fault_debt) map.fail("fault_debt", "must be above degraded_debt");
  in.wheel_speed_mps = read_span(map, "wheel_speed_mps", 0.0, 150.0);
  in.brake_kpa = read_span(map, "brake_kpa", 0.0, 8191.0);
  in.throttle_fraction = read_span(map, "throttle_fraction", 0.0, 2.0);
  in.steering_motor_deg = read_span(map, "steering_motor_deg", -512.0, 511.5);
  in.engine_speed_rpm = read_span(map, "engine_speed_rpm", 0.0, 16000.0);
  in.battery_v = read_span(map, "battery_v", 0.0, 25.5);
  in.tyre_temperature_c = read_span(map, "tyre_temperature_c", -100.0, 6453.0);
  in.tyre_pressure_kpa = read_span(map, "tyre_pressure_kpa", -100.0, 6553.0);
  in.gear_max = static_cast<std::uint8_t>(map.integer("gear_max", 1, 8));
}

void read_identity(yaml::StrictMap map, gateway::IdentityParams& identity) {
  identity.listen = time_s(map, "listen_s", gateway::kListenLeast.seconds(), 10.0);
}

void read_handshake(yaml::StrictMap map, gateway::HandshakeParams& handshake) {
  read_ranges(map, gateway::kHandshakeRanges, handshake);
  read_ranges(map, gateway::kHandshakeTimes, handshake);
}

void read_outbound(yaml::StrictMap map, gateway::OutboundParams& out) {
  read_ranges(map, gateway::kOutboundRanges, out);
  out.vehicle_number = static_cast<std::uint8_t>(map.integer("vehicle_number", 0, 255));
  out.traction_aim = static_cast<std::uint8_t>(map.integer("traction_aim", 0, 4));
  out.traction_range = static_cast<std::uint8_t>(map.integer("traction_range", 0, 4));
}

// Of a row of the watchdog; zero: not judged.
void read_figures(yaml::StrictMap& row, safety::StreamLimit& limit) {
  safety::RateLimit& rate = limit.rate;
  rate.warning_hz = row.number_or("rate_warning_hz", rate.warning_hz, 0.0, 1000.0);
  rate.bad_hz = row.number_or("rate_bad_hz", rate.bad_hz, 0.0, 1000.0);
  if (rate.bad_hz > rate.warning_hz) row.fail("rate_bad_hz", "must not be above rate_warning_hz");
  const auto read = [&](const char* warning, const char* bad, safety::DurationLimit& of) {
    of.warning = from_seconds(row.number_or(warning, of.warning.seconds(), 0.0, 60.0));
    of.bad = from_seconds(row.number_or(bad, of.bad.seconds(), 0.0, 60.0));
    if (of.warning > of.bad) row.fail(bad, std::string{"must not be below "} + warning);
  };
  read("latency_warning_s", "latency_bad_s", limit.latency);
  read("gap_warning_s", "gap_bad_s", limit.gap);
}

// Rows by the names of the table; a row that is not written keeps the module's limits.
void read_watchdog(yaml::StrictMap map, safety::WatchdogParams& watchdog) {
  for (safety::StreamLimit& limit : watchdog.limits) {
    auto row = map.optional_map(limit.name);
    if (!row) continue;
    limit.watched = row->flag_or("watched", limit.watched);
    limit.warning = from_seconds(row->number_or("warning_s", limit.warning.seconds(), 0.005, 60.0));
    limit.bad = from_seconds(row->number_or("bad_s", limit.bad.seconds(), 0.02, 60.0));
    if (limit.warning >= limit.bad) row->fail("bad_s", "must be above warning_s");
    read_figures(*row, limit);
  }
}

safety::FollowLimits read_follow(yaml::StrictMap map, double tolerance_max) {
  return {.settle_s = map.number("settle_s", 0.05, 2.0),
          .tolerance = map.number("tolerance", 0.0, tolerance_max),
          .share = map.number("share", 0.0, 0.5),
          .persist = time_s(map, "persist_s", 0.03, 0.3)};
}

void read_following(yaml::StrictMap map, safety::ActuatorParams& following) {
  following.steering = read_follow(map.map("steering"), 1.0);
  following.brake = read_follow(map.map("brake"), 2000.0);
  following.throttle = read_follow(map.map("throttle"), 0.5);
  following.unexplained_max_rad = map.number("unexplained_max_rad", 0.002, 0.05);
  following.moving_mps = map.number("moving_mps", 1.0, 20.0);
}

void read_oversteer(yaml::StrictMap map, safety::OversteerParams& oversteer) {
  read_ranges(map, safety::kOversteerRanges, oversteer);
}

void read_computer(yaml::StrictMap map, safety::ComputerParams& computer) {
  read_ranges(map, safety::kComputerRanges, computer);
}

void read_clock(yaml::StrictMap map, safety::ClockParams& clock) {
  read_ranges(map, safety::kClockRanges, clock);
  clock.show = time_s(map, "show_s", 0.1, 60.0);
}

void read_faults(yaml::StrictMap map, safety::FaultParams& faults) {
  if (faults.dead_reckoning_coast >= faults.dead_reckoning_max)
    map.fail("dead_reckoning_coast_s", "must be below dead_reckoning_max_s");
  read_ranges(map, safety::kFaultRanges, faults);
  read_ranges(map, safety::kFaultTimes, faults);
  faults.bus_dead = time_s(map, "bus_dead_s", 0.03, 0.1);
  faults.control_failures = static_cast<std::uint8_t>(map.integer("control_failures", 1, 20));
  faults.refused_ticks = static_cast<std::uint8_t>(map.integer("refused_ticks", 1, 20));
  faults.radio_loss_stops = map.flag("radio_loss_stops");
  faults.race_control_required = map.flag("race_control_required");
  read_following(map.map("following"), faults.following);
  read_oversteer(map.map("oversteer"), faults.oversteer);
  read_computer(map.map("computer"), faults.computer);
  read_clock(map.map("clock"), faults.clock);
}

void read_safe_stop(yaml::StrictMap map, safety::SafeStopParams& stop) {
  read_ranges(map, safety::kSafeStopRanges, stop);
  stop.emergency_ramp_kpa_per_s =
      map.number("emergency_ramp_kpa_per_s", stop.brake_ramp_kpa_per_s, 30000.0);
  stop.decel_max_mps2 = map.number("decel_max_mps2", stop.decel_min_mps2, 15.0);
  stop.decel_without_plan_mps2 =
      map.number("decel_without_plan_mps2", stop.decel_min_mps2, stop.decel_max_mps2);
  stop.emergency_decel_mps2 = map.number("emergency_decel_mps2", stop.decel_max_mps2, 25.0);
  stop.emergency_grip_share = map.number("emergency_grip_share", stop.grip_share, 1.0);
}

void read_supervisor(yaml::StrictMap map, safety::SupervisorParams& supervisor) {
  read_faults(map.map("faults"), supervisor.faults);
  read_safe_stop(map.map("safe_stop"), supervisor.safe_stop);
  read_ranges(map, safety::kSupervisorRanges, supervisor);
  read_ranges(map, safety::kSupervisorTimes, supervisor);
  supervisor.shift_least = time_s(map, "shift_least_s", 0.1, 2.0);
  supervisor.go_needs_driving_state = map.flag("go_needs_driving_state");
  if (supervisor.coast_max <= supervisor.coast_dwell)
    map.fail("coast_max_s", "must be above coast_dwell_s");
}

void read_steer_rows(yaml::StrictMap& map, safety::GateParams& gate) {
  const auto speeds =
      map.numbers("steer_speed_mps", safety::kSteerRows, safety::kSteerRows, 0.0, 110.0);
  const auto angles =
      map.numbers("steer_motor_deg", safety::kSteerRows, safety::kSteerRows, 5.0, 300.0);
  for (std::size_t i = 0; i < safety::kSteerRows; ++i) {
    if (i > 0 && speeds[i] <= speeds[i - 1]) map.fail("steer_speed_mps", "speeds must rise");
    if (i > 0 && angles[i] > angles[i - 1]) map.fail("steer_motor_deg", "angles must not rise");
    gate.steer[i] = {speeds[i], angles[i]};
  }
}

void read_stop_brake_rows(yaml::StrictMap& map, safety::GateParams& gate) {
  constexpr std::size_t kRows = safety::kStopBrakeRows;
  const auto speeds = map.numbers("stop_brake_speed_mps", kRows, kRows, 0.0, 110.0);
  const auto pressures = map.numbers("stop_brake_kpa", kRows, kRows, 500.0, 8191.0);
  for (std::size_t i = 0; i < kRows; ++i) {
    if (i > 0 && speeds[i] <= speeds[i - 1]) map.fail("stop_brake_speed_mps", "speeds must rise");
    if (i > 0 && pressures[i] < pressures[i - 1])
      map.fail("stop_brake_kpa", "pressures must not fall");
    gate.stop_brake[i] = {speeds[i], pressures[i]};
  }
}

void read_gate(yaml::StrictMap map, safety::GateParams& gate) {
  read_steer_rows(map, gate);
  read_stop_brake_rows(map, gate);
  read_ranges(map, safety::kGateRanges, gate);
  read_ranges(map, safety::kGateTimes, gate);
  gate.gear_max = static_cast<std::uint8_t>(map.integer("gear_max", 1, 8));
}

void read_bus_guard(yaml::StrictMap map, safety::BusGuardParams& guard) {
  guard.restarts = static_cast<std::uint8_t>(map.integer("restarts", 0, safety::kRestartsMax));
  read_ranges(map, safety::kBusGuardTimes, guard);
}

constexpr double kWarm_c = 90.0;  // tyres at their best

// What the supervisor may ask for must be what the gate lets pass: a command at its own limit would
// otherwise be refused.
void check_slews(const yaml::StrictMap& map, const CarParams& params) {
  const safety::SupervisorParams& s = params.supervisor;
  const safety::GateParams& g = params.gate;
  if (to_deg(s.steer_slew_rad_per_s) * s.steering_ratio >= g.steer_slew_deg_per_s)
    map.fail("steer_slew_rad_per_s",
             "times steering_ratio must be below gate.steer_slew_deg_per_s");
  if (100.0 * s.throttle_rise_per_s >= g.throttle_rise_percent_per_s)
    map.fail("throttle_rise_per_s", "must be below gate.throttle_rise_percent_per_s");
  if (s.brake_rise_kpa_per_s >= g.brake_rise_kpa_per_s)
    map.fail("brake_rise_kpa_per_s", "must be below gate.brake_rise_kpa_per_s");
  if (s.brake_fall_kpa_per_s >= g.brake_fall_kpa_per_s)
    map.fail("brake_fall_kpa_per_s", "must be below gate.brake_fall_kpa_per_s");
  if (s.shift_least <= g.shift_least) map.fail("shift_least_s", "must be above gate.shift_least_s");
  if (s.safe_stop.hold_kpa <= g.hold_least_kpa)
    map.fail("safe_stop", "hold_kpa must be above gate.hold_least_kpa");
  for (const safety::StopBrakeRow& row : g.stop_brake) {
    const safety::Grip grip = safety::grip_at(s.safe_stop, row.speed_mps, 0.0, 0.0, kWarm_c);
    const double grip_kpa =
        grip.total_mps2 * s.safe_stop.brake_share * s.safe_stop.brake_kpa_per_mps2;
    if (row.kpa < std::min(grip_kpa, s.safe_stop.brake_max_kpa))
      map.fail(
          "safe_stop",
          formatted("brake pressure of friction: %.0f kPa at %.1f m/s, above gate.stop_brake_kpa",
                    std::min(grip_kpa, s.safe_stop.brake_max_kpa), row.speed_mps));
  }
}

}  // namespace

void read_gateway(yaml::StrictMap map, CarParams& params) {
  read_inbound(map.map("inbound"), params.inbound);
  read_identity(map.map("identity"), params.identity);
  read_handshake(map.map("handshake"), params.handshake);
  read_outbound(map.map("outbound"), params.outbound);
  params.outbound.tick = params.rates.tick;
}

void read_safety(yaml::StrictMap map, CarParams& params) {
  read_watchdog(map.map("watchdog"), params.watchdog);
  yaml::StrictMap supervisor = map.map("supervisor");
  read_supervisor(supervisor, params.supervisor);
  params.supervisor.steering_ratio = params.outbound.steering_ratio;
  read_gate(map.map("gate"), params.gate);
  params.supervisor.gate = params.gate;
  read_bus_guard(map.map("bus_guard"), params.bus_guard);
  check_slews(supervisor, params);
}

}  // namespace pitwall::parameters
