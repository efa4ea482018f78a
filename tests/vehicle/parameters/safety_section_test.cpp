// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "protocol/vocabulary/units.hpp"
#include "tests/vehicle/parameters/mutation.hpp"
#include "vehicle/parameters/car_file.hpp"

namespace pitwall::parameters {
namespace {

using pipeline::CarParams;
using testing::av21;
using testing::refusal;
using testing::Reported;
using testing::with;

Reported gateway(const CarParams& p) {
  return {
      {"gateway.inbound.degraded_debt", p.inbound.degraded_debt},
      {"gateway.inbound.fault_debt", p.inbound.fault_debt},
      {"gateway.inbound.wheel_speed_mps[0]", p.inbound.wheel_speed_mps.min},
      {"gateway.inbound.wheel_speed_mps[1]", p.inbound.wheel_speed_mps.max},
      {"gateway.inbound.brake_kpa[0]", p.inbound.brake_kpa.min},
      {"gateway.inbound.brake_kpa[1]", p.inbound.brake_kpa.max},
      {"gateway.inbound.throttle_fraction[0]", p.inbound.throttle_fraction.min},
      {"gateway.inbound.throttle_fraction[1]", p.inbound.throttle_fraction.max},
      {"gateway.inbound.steering_motor_deg[0]", p.inbound.steering_motor_deg.min},
      {"gateway.inbound.steering_motor_deg[1]", p.inbound.steering_motor_deg.max},
      {"gateway.inbound.engine_speed_rpm[0]", p.inbound.engine_speed_rpm.min},
      {"gateway.inbound.engine_speed_rpm[1]", p.inbound.engine_speed_rpm.max},
      {"gateway.inbound.battery_v[0]", p.inbound.battery_v.min},
      {"gateway.inbound.battery_v[1]", p.inbound.battery_v.max},
      {"gateway.inbound.tyre_temperature_c[0]", p.inbound.tyre_temperature_c.min},
      {"gateway.inbound.tyre_temperature_c[1]", p.inbound.tyre_temperature_c.max},
      {"gateway.inbound.tyre_pressure_kpa[0]", p.inbound.tyre_pressure_kpa.min},
      {"gateway.inbound.tyre_pressure_kpa[1]", p.inbound.tyre_pressure_kpa.max},
      {"gateway.inbound.gear_max", p.inbound.gear_max},
      {"gateway.handshake.dwell_s", p.handshake.dwell.seconds()},
      {"gateway.handshake.standstill_mps", p.handshake.standstill_mps},
      {"gateway.identity.listen_s", p.identity.listen.seconds()},
      {"gateway.outbound.steering_ratio", p.outbound.steering_ratio},
      {"gateway.outbound.vehicle_number", p.outbound.vehicle_number},
      {"gateway.outbound.traction_aim", p.outbound.traction_aim},
      {"gateway.outbound.traction_range", p.outbound.traction_range},
  };
}

Reported faults(const CarParams& p) {
  Reported reported{
      {"safety.supervisor.faults.dead_reckoning_max_s",
       p.supervisor.faults.dead_reckoning_max.seconds()},
      {"safety.supervisor.faults.dead_reckoning_coast_s",
       p.supervisor.faults.dead_reckoning_coast.seconds()},
      {"safety.supervisor.faults.gnss_sigma_max_m", p.supervisor.faults.gnss_sigma_max_m},
      {"safety.supervisor.faults.following.unexplained_max_rad",
       p.supervisor.faults.following.unexplained_max_rad},
      {"safety.supervisor.faults.following.moving_mps", p.supervisor.faults.following.moving_mps},
      {"safety.supervisor.faults.oversteer.speed_min_mps",
       p.supervisor.faults.oversteer.speed_min_mps},
      {"safety.supervisor.faults.oversteer.rear_spin_max",
       p.supervisor.faults.oversteer.rear_spin_max},
      {"safety.supervisor.faults.oversteer.rear_lock_max",
       p.supervisor.faults.oversteer.rear_lock_max},
      {"safety.supervisor.faults.oversteer.yaw_excess_max_rad_per_s",
       p.supervisor.faults.oversteer.yaw_excess_max_rad_per_s},
      {"safety.supervisor.faults.computer.idle_share", p.supervisor.faults.computer.idle_share},
      {"safety.supervisor.faults.computer.late_max_s", p.supervisor.faults.computer.late_max_s},
      {"safety.supervisor.faults.computer.processor_warn",
       p.supervisor.faults.computer.processor_warn},
      {"safety.supervisor.faults.computer.memory_max_mib",
       p.supervisor.faults.computer.memory_max_mib},
      {"safety.supervisor.faults.computer.temperature_max_c",
       p.supervisor.faults.computer.temperature_max_c},
      {"safety.supervisor.faults.clock.step_s", p.supervisor.faults.clock.step_s},
      {"safety.supervisor.faults.clock.skew_max_ppm", p.supervisor.faults.clock.skew_max_ppm},
      {"safety.supervisor.faults.clock.show_s", p.supervisor.faults.clock.show.seconds()},
      {"safety.supervisor.faults.bus_dead_s", p.supervisor.faults.bus_dead.seconds()},
      {"safety.supervisor.faults.bus_dead_disarm_s", p.supervisor.faults.bus_dead_disarm.seconds()},
      {"safety.supervisor.faults.position_sigma_max_m", p.supervisor.faults.position_sigma_max_m},
      {"safety.supervisor.faults.control_failures", p.supervisor.faults.control_failures},
      {"safety.supervisor.faults.refused_ticks", p.supervisor.faults.refused_ticks},
  };
  const auto& following = p.supervisor.faults.following;
  for (const auto& [name, limits] :
       {std::pair{"steering", following.steering}, std::pair{"brake", following.brake},
        std::pair{"throttle", following.throttle}}) {
    const std::string path = std::string("safety.supervisor.faults.following.") + name;
    reported[path + ".settle_s"] = limits.settle_s;
    reported[path + ".tolerance"] = limits.tolerance;
    reported[path + ".share"] = limits.share;
    reported[path + ".persist_s"] = limits.persist.seconds();
  }
  return reported;
}

Reported supervisor(const CarParams& p) {
  return {
      {"safety.supervisor.coast_dwell_s", p.supervisor.coast_dwell.seconds()},
      {"safety.supervisor.coast_max_s", p.supervisor.coast_max.seconds()},
      {"safety.supervisor.coast_brakes_below_mps", p.supervisor.coast_brakes_below_mps},
      {"safety.supervisor.safe_stop.brake_kpa_per_mps2", p.supervisor.safe_stop.brake_kpa_per_mps2},
      {"safety.supervisor.safe_stop.brake_ramp_kpa_per_s",
       p.supervisor.safe_stop.brake_ramp_kpa_per_s},
      {"safety.supervisor.safe_stop.emergency_ramp_kpa_per_s",
       p.supervisor.safe_stop.emergency_ramp_kpa_per_s},
      {"safety.supervisor.safe_stop.brake_max_kpa", p.supervisor.safe_stop.brake_max_kpa},
      {"safety.supervisor.safe_stop.hold_kpa", p.supervisor.safe_stop.hold_kpa},
      {"safety.supervisor.safe_stop.decel_min_mps2", p.supervisor.safe_stop.decel_min_mps2},
      {"safety.supervisor.safe_stop.decel_max_mps2", p.supervisor.safe_stop.decel_max_mps2},
      {"safety.supervisor.safe_stop.decel_without_plan_mps2",
       p.supervisor.safe_stop.decel_without_plan_mps2},
      {"safety.supervisor.safe_stop.emergency_decel_mps2",
       p.supervisor.safe_stop.emergency_decel_mps2},
      {"safety.supervisor.safe_stop.friction", p.supervisor.safe_stop.friction},
      {"safety.supervisor.safe_stop.brake_share", p.supervisor.safe_stop.brake_share},
      {"safety.supervisor.safe_stop.coast_mps2", p.supervisor.safe_stop.coast_mps2},
      {"safety.supervisor.safe_stop.grip_share", p.supervisor.safe_stop.grip_share},
      {"safety.supervisor.safe_stop.emergency_grip_share",
       p.supervisor.safe_stop.emergency_grip_share},
      {"safety.supervisor.safe_stop.steer_settle_s", p.supervisor.safe_stop.steer_settle_s},
      {"safety.supervisor.safe_stop.motor_fault_bandwidth_share",
       p.supervisor.safe_stop.motor_fault_bandwidth_share},
      {"safety.supervisor.safe_stop.speed_share_per_s", p.supervisor.safe_stop.speed_share_per_s},
      {"safety.supervisor.safe_stop.brake_preview_s", p.supervisor.safe_stop.brake_preview_s},
      {"safety.supervisor.safe_stop.throttle_fall_per_s",
       p.supervisor.safe_stop.throttle_fall_per_s},
      {"safety.supervisor.safe_stop.hold_ramp_kpa_per_s",
       p.supervisor.safe_stop.hold_ramp_kpa_per_s},
      {"safety.supervisor.safe_stop.lock_slip", p.supervisor.safe_stop.lock_slip},
      {"safety.supervisor.safe_stop.lock_release_per_s", p.supervisor.safe_stop.lock_release_per_s},
      {"safety.supervisor.safe_stop.lock_recover_per_s", p.supervisor.safe_stop.lock_recover_per_s},
      {"safety.supervisor.safe_stop.lock_share_least", p.supervisor.safe_stop.lock_share_least},
      {"safety.supervisor.safe_stop.standstill_mps", p.supervisor.safe_stop.standstill_mps},
      {"safety.supervisor.standstill_dwell_s", p.supervisor.standstill_dwell.seconds()},
      {"safety.supervisor.standstill_mps", p.supervisor.standstill_mps},
      {"safety.supervisor.steer_slew_rad_per_s", p.supervisor.steer_slew_rad_per_s},
      {"safety.supervisor.throttle_rise_per_s", p.supervisor.throttle_rise_per_s},
      {"safety.supervisor.brake_rise_kpa_per_s", p.supervisor.brake_rise_kpa_per_s},
      {"safety.supervisor.brake_fall_kpa_per_s", p.supervisor.brake_fall_kpa_per_s},
      {"safety.supervisor.shift_least_s", p.supervisor.shift_least.seconds()},
  };
}

Reported gate(const CarParams& p) {
  Reported reported{
      {"safety.gate.stop_steer_share", p.gate.stop_steer_share},
      {"safety.gate.hold_steer_slew_deg_per_s", p.gate.hold_steer_slew_deg_per_s},
      {"safety.gate.hold_least_kpa", p.gate.hold_least_kpa},
      {"safety.gate.steer_slew_deg_per_s", p.gate.steer_slew_deg_per_s},
      {"safety.gate.brake_max_kpa", p.gate.brake_max_kpa},
      {"safety.gate.brake_rise_kpa_per_s", p.gate.brake_rise_kpa_per_s},
      {"safety.gate.brake_fall_kpa_per_s", p.gate.brake_fall_kpa_per_s},
      {"safety.gate.throttle_max_percent", p.gate.throttle_max_percent},
      {"safety.gate.throttle_rise_percent_per_s", p.gate.throttle_rise_percent_per_s},
      {"safety.gate.both_throttle_percent", p.gate.both_throttle_percent},
      {"safety.gate.both_brake_kpa", p.gate.both_brake_kpa},
      {"safety.gate.standing_mps", p.gate.standing_mps},
      {"safety.gate.gear_max", p.gate.gear_max},
      {"safety.gate.shift_least_s", p.gate.shift_least.seconds()},
      {"safety.gate.command_age_max_s", p.gate.command_age_max.seconds()},
      {"safety.bus_guard.restarts", p.bus_guard.restarts},
      {"safety.bus_guard.window_s", p.bus_guard.window.seconds()},
      {"safety.bus_guard.pause_s", p.bus_guard.pause.seconds()},
      {"safety.bus_guard.stall_max_s", p.bus_guard.stall_max.seconds()},
  };
  for (std::size_t i = 0; i < safety::kStopBrakeRows; ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    reported["safety.gate.stop_brake_speed_mps" + index] = p.gate.stop_brake[i].speed_mps;
    reported["safety.gate.stop_brake_kpa" + index] = p.gate.stop_brake[i].kpa;
  }
  for (std::size_t i = 0; i < safety::kSteerRows; ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    reported["safety.gate.steer_speed_mps" + index] = p.gate.steer[i].speed_mps;
    reported["safety.gate.steer_motor_deg" + index] = p.gate.steer[i].motor_deg;
  }
  return reported;
}

Reported safety(const CarParams& p) {
  const auto& radio = p.watchdog.limits[static_cast<std::size_t>(safety::Stream::kRadio)];
  Reported reported{
      {"safety.watchdog.radio.warning_s", radio.warning.seconds()},
      {"safety.watchdog.radio.bad_s", radio.bad.seconds()},
  };
  for (const Reported& part : {faults(p), supervisor(p), gate(p)})
    reported.insert(part.begin(), part.end());
  return reported;
}

TEST(SafetySection, EachNumberOfTheGatewayMovesItsOwnParameter) {
  testing::expect_each_number_to_move_its_own("gateway", gateway);
}

TEST(SafetySection, EachNumberOfSafetyMovesItsOwnParameter) {
  testing::expect_each_number_to_move_its_own("safety", safety);
}

TEST(SafetySection, ReadsTheFlags) {
  const auto params = [](const std::string& text) {
    auto car = read_car(text, "car.yaml");
    return car ? car->params : throw std::runtime_error(to_string(car.error()));
  };
  const auto faults = [&](const std::string& text) { return params(text).supervisor.faults; };
  EXPECT_TRUE(faults(av21()).radio_loss_stops);
  EXPECT_FALSE(
      faults(with(av21(), "radio_loss_stops: true", "radio_loss_stops: false")).radio_loss_stops);
  EXPECT_TRUE(faults(av21()).race_control_required);
  EXPECT_FALSE(faults(with(av21(), "race_control_required: true", "race_control_required: false"))
                   .race_control_required);
  EXPECT_TRUE(params(av21()).supervisor.go_needs_driving_state);
  EXPECT_FALSE(params(with(av21(), "go_needs_driving_state: true", "go_needs_driving_state: false"))
                   .supervisor.go_needs_driving_state);
  EXPECT_EQ(
      params(with(av21(), "flag_encoding: mylaps", "flag_encoding: marelli")).inbound.flag_encoding,
      world::FlagEncoding::kMarelli);
  EXPECT_EQ(params(av21()).inbound.flag_encoding, world::FlagEncoding::kMyLaps);
  const std::string why = refusal(with(av21(), "flag_encoding: mylaps", "flag_encoding: iac"));
  EXPECT_NE(why.find("mylaps, marelli"), std::string::npos) << why;
}

// Each row of the watchdog by its name; what is not written keeps the module's limits.
TEST(SafetySection, ReadsEveryRowOfTheWatchdog) {
  const safety::WatchdogParams defaults;
  for (std::size_t i = 0; i < safety::kStreams; ++i) {
    const std::string name = defaults.limits[i].name;
    const std::string row = name + ": {watched: false, warning_s: 0.5, bad_s: 1.5}";
    const auto car = read_car(
        with(av21(), "radio: {watched: true, warning_s: 1.0, bad_s: 3.0}", row), "car.yaml");
    ASSERT_TRUE(car) << name << ": " << to_string(car.error());
    for (std::size_t k = 0; k < safety::kStreams; ++k) {
      const safety::StreamLimit& limit = car->params.watchdog.limits[k];
      const safety::StreamLimit& module = defaults.limits[k];
      EXPECT_EQ(limit.watched, k == i ? false : module.watched) << name;
      EXPECT_EQ(limit.warning, k == i ? milliseconds(500) : module.warning) << name;
      EXPECT_EQ(limit.bad, k == i ? milliseconds(1500) : module.bad) << name;
    }
  }
}

TEST(SafetySection, RefusesWhatContradictsItself) {
  const auto refused = [](const char* what, const char* by, const char* key) {
    const std::string why = refusal(with(av21(), what, by));
    EXPECT_NE(why.find(key), std::string::npos) << by << ": " << why;
  };
  refused("radio: {watched: true, warning_s: 1.0, bad_s: 3.0}", "radio: {warning_s: 2, bad_s: 1}",
          "bad_s");
  refused("radio: {watched: true, warning_s: 1.0, bad_s: 3.0}", "radio: {warning_s: 2, bad_s: 2}",
          "bad_s");
  refused("radio: {watched: true, warning_s: 1.0, bad_s: 3.0}", "gnss9 link: {watched: false}",
          "gnss9 link");
  refused("fault_debt: 5", "fault_debt: 3", "fault_debt");
  refused("brake_kpa: [0, 8000]", "brake_kpa: [8000, 0]", "brake_kpa");
  refused("battery_v: [0, 20]", "battery_v: [20, 20]", "battery_v");
  refused("steer_speed_mps: [0, 15, 20", "steer_speed_mps: [0, 20, 20", "steer_speed_mps");
  refused("steer_motor_deg: [240, 240, 230", "steer_motor_deg: [240, 230, 240", "steer_motor_deg");
  refused("decel_min_mps2: 2.0", "decel_min_mps2: 5.0", "decel_without_plan_mps2");
  refused("emergency_grip_share: 0.8", "emergency_grip_share: 0.5", "emergency_grip_share");
  // The gate would refuse what the supervisor may ask for.
  refused("steer_slew_deg_per_s: 720", "steer_slew_deg_per_s: 500", "steer_slew_rad_per_s");
  refused("throttle_rise_percent_per_s: 400", "throttle_rise_percent_per_s: 200",
          "throttle_rise_per_s");
  refused("    brake_rise_kpa_per_s: 15000", "    brake_rise_kpa_per_s: 30000",
          "brake_rise_kpa_per_s");
  refused("    brake_fall_kpa_per_s: 60000", "    brake_fall_kpa_per_s: 30000",
          "brake_fall_kpa_per_s");
  refused("shift_least_s: 0.15", "shift_least_s: 0.1", "shift_least_s");
  refused("emergency_ramp_kpa_per_s: 12000", "emergency_ramp_kpa_per_s: 600",
          "emergency_ramp_kpa_per_s");
}

}  // namespace
}  // namespace pitwall::parameters
