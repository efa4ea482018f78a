// CAN frames of a healthy car for the gateway tests.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "protocol/can/av21.hpp"
#include "protocol/can/encode.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/random.hpp"
#include "protocol/vocabulary/time.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::gateway::testing {

namespace av21 = can::av21;

template <class M>
can::Frame frame_of(const M& message) {
  can::Frame frame;
  can::EncodeCounters counters;
  EXPECT_TRUE(av21::encode(message, frame, counters)) << M::kName;
  EXPECT_EQ(counters.saturated, 0u) << M::kName;
  return frame;
}

inline can::Frame wheels(double kmph) {
  av21::WheelSpeedReport m;
  m.wheel_speed_FL = m.wheel_speed_FR = m.wheel_speed_RL = m.wheel_speed_RR = kmph;
  return frame_of(m);
}

inline can::Frame steering(double motor_deg, std::uint8_t counter) {
  av21::SteeringReport m;
  m.steering_motor_ang_avg_fdbk = motor_deg;
  m.steering_motor_fdbk_counter = counter;
  return frame_of(m);
}

inline can::Frame brake(double kpa, std::uint8_t counter) {
  av21::BrakePressureReport m;
  m.brake_pressure_fdbk_front = m.brake_pressure_fdbk_rear = kpa;
  m.brk_pressure_fdbk_counter = counter;
  return frame_of(m);
}

struct MyLaps {
  std::uint8_t heartbeat = 0, track = 0, vehicle = 0, speed_mph = 0, laps = 0;
};
inline can::Frame summary(const MyLaps& flags) {
  av21::BaseToCarSummary m;
  m.base_to_car_heartbeat = flags.heartbeat;
  m.track_flag = flags.track;
  m.veh_flag = flags.vehicle;
  m.veh_rank = 1;
  m.round_target_speed = flags.speed_mph;
  m.lap_count = flags.laps;
  m.lap_distance = 0;
  return frame_of(m);
}

struct Marelli {
  std::uint8_t track = 0, vehicle = 0, sector = 0;
  bool synchronised = true;
};
inline can::Frame marelli(const Marelli& flags) {
  av21::MarelliReport1 m;
  m.marelli_track_flag = flags.track;
  m.marelli_vehicle_flag = flags.vehicle;
  m.marelli_sector_flag = flags.sector;
  m.marelli_rc_base_sync_check = flags.synchronised ? 1.0 : 0.0;
  m.marelli_rc_lte_rssi = -60;
  return frame_of(m);
}

// Zero bytes of the right length are a valid frame of every message of the car, except the tyre
// temperatures, which then read -100 degrees.
inline can::Frame empty_frame(const can::MessageRow& row) {
  can::Frame frame;
  frame.id = row.id;
  frame.length = row.length;
  return frame;
}

}  // namespace pitwall::gateway::testing
