// Simulated car under the supervisor's command, in virtual time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/vehicle/safety/situation.hpp"
#include "vehicle/safety/supervisor.hpp"

namespace pitwall::safety::testing {

// A car that executes every command: 250 kPa for 1 m/s^2, 6 m/s^2 with full throttle.
struct Drive {
  SupervisorParams params;
  SupervisorState state;
  Situation car;
  double speed_mps = 0.0;
  Instant now = Instant{} + seconds(5);
  bool wheels_known = true;
  std::array<double, world::kCorners> wheel_factors{1.0, 1.0, 1.0, 1.0};  // of the car's speed
  SupervisorOutput out;
  steering::Learned learned{};

  const SupervisorOutput& tick() {
    now += milliseconds(10);
    car.at(now, speed_mps);
    for (std::size_t i = 0; i < world::kCorners; ++i)
      car.signals.wheel_speed_mps.value.at[i] = car.signals.wheel_speed_before_mps.value.at[i] =
          wheel_factors[i] * speed_mps;
    if (!wheels_known) car.signals.wheel_speed_mps.received = false;
    out = supervise(params, state,
                    {.signals = car.signals,
                     .bus = car.bus,
                     .race_control = car.race_control,
                     .ego = car.ego,
                     .watchdog = car.watchdog,
                     .stop = car.stop,
                     .control = car.control,
                     .control_ok = car.control_ok,
                     .drive_available = car.drive_available,
                     .own_id_seen = car.own_id_seen,
                     .bus_failed = car.bus_failed,
                     .gate_refused = car.gate_refused,
                     .operator_requests = car.requests,
                     .last_run_armed = car.last_run_armed,
                     .radio = car.radio,
                     .learned = learned},
                    now);
    const double brake = std::isfinite(out.command.brake_kpa) ? out.command.brake_kpa : 0.0;
    const double pedal =
        std::isfinite(out.command.throttle_fraction) ? out.command.throttle_fraction : 0.0;
    speed_mps = std::max(0.0, speed_mps + (6.0 * pedal - brake / 250.0) * 0.01);
    return out;
  }
  void run(Duration span) {
    for (const Instant end = now + span; now < end;) tick();
  }
  // Sets the age of all drive-by-wire streams; zero: just received.
  void silence(Duration age) {
    for (auto s = static_cast<std::size_t>(Stream::kWheelSpeed);
         s <= static_cast<std::size_t>(Stream::kDiagnostics); ++s)
      car.watchdog.rows[s].age = age;
  }
  // All drive-by-wire streams are lost, wheel speeds included; the car still executes commands.
  void kill_bus() {
    silence(milliseconds(71));
    wheels_known = false;
  }
  void revive_bus() {
    silence({});
    wheels_known = true;
  }
  void race() {
    car.requests.arm = true;
    run(milliseconds(50));
    ASSERT_EQ(out.mode, world::Mode::kDriving);
    run(seconds(5));
    ASSERT_GT(speed_mps, 5.0);
  }
};

}  // namespace pitwall::safety::testing
