// Inputs of the supervisor in a healthy situation, which a test changes one by one.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/random.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/safety/fault_detection.hpp"
#include "vehicle/safety/link_loss_policy.hpp"
#include "vehicle/safety/watchdog.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/health.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/signals.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::safety::testing {

struct Situation {
  world::VehicleSignals signals;
  world::BusHealth bus;
  world::RaceControl race_control;
  world::EgoState ego;
  WatchdogOutput watchdog;
  world::Trajectory stop;
  world::ActuatorCommand control;
  OperatorRequests requests;
  LinkLossOutput radio;
  bool control_ok = true, drive_available = true, own_id_seen = false, bus_failed = false,
       gate_refused = false, last_run_armed = false;

  Situation() {
    for (std::size_t i = 0; i < kStreams; ++i)
      watchdog.rows[i] = {static_cast<Stream>(i), Health::kGood, milliseconds(5)};
    bus.identity.verdict = world::IdentityVerdict::kRight;
    race_control.ever_received = true;
    race_control.track = world::TrackFlag::kGreen;
    race_control.vehicle = world::VehicleFlag::kNone;
    ego.validity = world::Validity::kGood;
    ego.position_sigma_m = 0.05;
    ego.ax_mps2 = ego.ay_mps2 = 0.0;
    signals.misc = {{.battery_v = 12.5, .sys_state = world::SysState::kDriving}, {}, true};
    signals.diagnostics.received = true;
    signals.steering_motor_rad = {0.0, {}, true};
    signals.powertrain.received = true;
    signals.powertrain.value.gear = 1;
    control = {
        .at = {}, .road_wheel_rad = 0.01, .throttle_fraction = 0.3, .brake_kpa = 0.0, .gear = 1};
    for (int i = 0; i < 100; ++i) {
      const bool pushed = stop.points.push({.s_m = 3.0 * i,
                                            .x_m = 3.0 * i,
                                            .y_m = 0.0,
                                            .yaw_rad = 0.0,
                                            .curvature_per_m = 0.002,
                                            .bank_rad = 0.1,
                                            .speed_mps = 60.0,
                                            .accel_mps2 = -6.0});
      static_cast<void>(pushed);
    }
    at(Instant{}, 0.0);
  }

  // Sets the time of all inputs to now.
  void at(Instant now, double speed_mps) {
    signals.wheel_speed_mps = {{{speed_mps, speed_mps, speed_mps, speed_mps}}, now, true};
    signals.wheel_speed_before_mps = signals.wheel_speed_mps;
    signals.wheel_speed_before_mps.at = now - milliseconds(5);
    ego.vx_mps = speed_mps;
    signals.tyre_temperature_c = {{{85.0, 85.0, 85.0, 85.0}}, now, true};
    bus.last_frame = now;
    ego.at = control.at = stop.at = now;
  }
  StreamRow& stream(Stream s) { return watchdog.rows[static_cast<std::size_t>(s)]; }
};

}  // namespace pitwall::safety::testing
