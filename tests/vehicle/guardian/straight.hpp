// Simulation of a car on a straight road and its guardian: frames and record of the car process,
// the reports of the drive-by-wire, and the effect of the brake on the speed.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "protocol/can/av21.hpp"
#include "vehicle/guardian/guardian.hpp"

namespace pitwall::guardian {

namespace av21 = can::av21;

inline constexpr double kSpeed_mps = 65.0, kDecel_mps2 = 5.0;
inline constexpr std::uint64_t kRun = 77;

// Stop along x with a constant deceleration, and 40 m beyond the standstill.
inline world::Trajectory straight_stop(double from_x_m, double speed_mps) {
  world::Trajectory stop;
  const double stop_m = speed_mps * speed_mps / (2.0 * kDecel_mps2);
  const double step_m = (stop_m + 40.0) / (world::kTrajectoryPoints - 1);
  for (std::size_t i = 0; i < world::kTrajectoryPoints; ++i) {
    const double s_m = step_m * static_cast<double>(i);
    const double v2 = speed_mps * speed_mps - 2.0 * kDecel_mps2 * s_m;
    (void)stop.points.push({.s_m = s_m,
                            .x_m = from_x_m + s_m,
                            .y_m = 0.0,
                            .yaw_rad = 0.0,
                            .curvature_per_m = 0.0,
                            .bank_rad = 0.0,
                            .speed_mps = std::sqrt(std::max(0.0, v2)),
                            .accel_mps2 = v2 > 0.0 ? -kDecel_mps2 : 0.0});
  }
  return stop;
}

class Straight {
 public:
  Params params;
  State state;
  Instant now{seconds(1000).ns};
  CarRecord record;
  bool car_sends = true, car_publishes = true, bus_lives = true, record_there = true;
  bool imus_live = true;
  double x_m = 0.0, y_m = 0.0, speed_mps = kSpeed_mps, brake_kpa = 0.0;
  std::uint8_t counter = 0;
  std::uint8_t report_counter = 0;
  std::vector<can::Frame> sent;    // by the guardian, in the last tick
  std::vector<can::Frame> so_far;  // by the guardian, in all ticks
  Output out;

  Straight() {
    record.run = kRun;
    record.mode = world::Mode::kDriving;
    record.armed = true;
    record.datum = {36.0, -115.0, 600.0};
  }

  // One millisecond; the car and the drive-by-wire send every ten.
  void tick() {
    now += milliseconds(1);
    move();
    std::vector<can::ReceivedFrame> incoming;
    if ((now - Instant{}).ns % milliseconds(10).ns == 0) {
      if (car_publishes) publish();
      if (car_sends) encode_frames(incoming);
      if (bus_lives) report(incoming);
    }
    world::SensorInput samples;
    for (std::uint8_t unit = 0; imus_live && unit < 2; ++unit)
      (void)samples.imu.push(
          {.unit = unit, .at = now, .rate_rad_per_s = {0, 0, 0}, .specific_force_mps2 = {0, 0, 9}});
    out = step(params, state,
               {.record = record_there ? &record : nullptr,
                .can = incoming,
                .sensors = samples,
                .now = now});
    sent.assign(out.frames.begin(), out.frames.end());
    so_far.insert(so_far.end(), sent.begin(), sent.end());
    execute();
  }

  void run(Duration span) {
    for (const Instant until = now + span; now < until;) tick();
  }
  // Runs until just after a transmission of the car process; from then on it is silent.
  void fall_silent() {
    while ((now - Instant{}).ns % milliseconds(10).ns != 0) tick();
    car_sends = car_publishes = false;
  }
  void drive_for_a_second() { run(seconds(1)); }
  Mode mode() const { return state.status.mode; }
  Cause cause() const { return state.status.cause; }

 private:
  void move() {
    speed_mps = std::max(0.0, speed_mps - brake_kpa / 250.0 * 1e-3);
    x_m += speed_mps * 1e-3;
  }

  void publish() {
    ++record.sequence;
    record.at = now;
    record.sends = car_sends;
    record.ego = {.at = now,
                  .validity = world::Validity::kGood,
                  .x_m = x_m,
                  .y_m = y_m,
                  .yaw_rad = 0.0,
                  .vx_mps = speed_mps,
                  .vy_mps = 0.0,
                  .yaw_rate_rad_per_s = 0.0};
    if (keep_stop) return;
    record.stop = straight_stop(x_m, speed_mps);
  }

  template <class M>
  void put(std::vector<can::ReceivedFrame>& incoming, const M& message) {
    can::EncodeCounters none;
    can::ReceivedFrame received;
    ASSERT_TRUE(av21::encode(message, received.frame, none));
    received.at = now;
    incoming.push_back(received);
  }

  void encode_frames(std::vector<can::ReceivedFrame>& incoming) {
    ++counter;
    report_counter = static_cast<std::uint8_t>((report_counter + 1) % 10);
    av21::BrakePressureCmd brake;
    brake.brake_pressure_cmd = 0.0;
    brake.brk_pressure_cmd_counter = counter;
    put(incoming, brake);
    av21::AcceleratorCmd throttle;
    throttle.acc_pedal_cmd = 40.0;
    throttle.acc_pedal_cmd_counter = counter;
    put(incoming, throttle);
    av21::SteeringCmd steering;
    steering.steering_motor_ang_cmd = 3.0;
    steering.steering_motor_cmd_counter = counter;
    put(incoming, steering);
    av21::GearShiftCmd gear;
    gear.desired_gear = 5;
    put(incoming, gear);
    av21::CtReport report;
    report.veh_sig_ack = 3;
    report.track_cond_ack = 2;
    report.ct_state = 9;
    report.ct_state_rolling_counter = report_counter;
    report.veh_num = 21;
    put(incoming, report);
  }

  void report(std::vector<can::ReceivedFrame>& incoming) {
    av21::WheelSpeedReport wheels;
    wheels.wheel_speed_FL = wheels.wheel_speed_FR = wheels.wheel_speed_RL = wheels.wheel_speed_RR =
        speed_mps * 3.6;
    put(incoming, wheels);
  }

  void execute() {
    for (const can::Frame& frame : sent) {
      av21::BrakePressureCmd brake;
      if (frame.id == av21::BrakePressureCmd::kId && av21::decode(frame, brake))
        brake_kpa = brake.brake_pressure_cmd;
    }
  }

 public:
  bool keep_stop = false;  // the record keeps its stop trajectory
};

// A car that has driven for a second, and whose process has then been silent for `span`.
inline Straight silent_for(Duration span) {
  Straight car;
  car.drive_for_a_second();
  car.fall_silent();
  car.run(span);
  return car;
}

}  // namespace pitwall::guardian
