// Decoder of one VectorNav VN-310: bytes to samples in the units and frames of the car.
//   in     bytes with the time of their arrival, from any transport, in pieces of any size; of the
//          outputs that vectornav_outputs.hpp names
//   out    world::SensorInput: positions and velocities of its first GNSS receiver, headings, IMU
//          samples, attitudes, each at its time of validity on the car's clock (gps_clock.hpp); its
//          status, once a second and at each change
//   frames positions WGS 84, height above the ellipsoid; IMU in Body (x forward, y left, z up) by
//          the mounting, attitude by the sensor's own reference frame rotation. The heading is that
//          of the car, not of the antennas: the car file has baseline_yaw_deg 0 for such a unit
//   units  SI and radians
//   invariants
//          a heading is output once a second, and only while the dual-antenna compass works: the
//          inertial solution holds it in between, so more samples would repeat the same measurement
//   errors counters per kind
//   source VectorNav binary output protocol (protocol/gnss/vectornav_message.hpp); VN-310 user
//          manual, InsStatus
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "protocol/gnss/vectornav_codec.hpp"
#include "protocol/gnss/vectornav_stream.hpp"
#include "vehicle/receivers/counters.hpp"
#include "vehicle/receivers/mounting.hpp"
#include "vehicle/receivers/sample_writer.hpp"
#include "vehicle/receivers/vectornav_outputs.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::receivers {

class VectorNav {
 public:
  VectorNav(std::uint8_t unit, Duration least_delay, const Mounting& mounting = kAsVectorNav)
      : mounting_(mounting), stream_(kVectorNavOutputs), writer_(unit, least_delay) {}

  void feed(std::span<const std::uint8_t> bytes, Instant arrival, world::SensorInput& out);

  Counters counters() const;

 private:
  static constexpr Duration kEvery = seconds(1);  // period of headings and of the status

  void use_imu(const gnss::VectorNavMessage& m, Instant arrival, world::SensorInput& out);
  void use_fix(const gnss::VectorNavMessage& m, Instant arrival, world::SensorInput& out);
  void use_position(const gnss::VectorNavSolution& s, gnss::GpsTime valid, Instant arrival,
                    world::SensorInput& out);
  void use_velocity(const gnss::VectorNavSolution& s, gnss::GpsTime valid, Instant arrival,
                    world::SensorInput& out);
  void use_ins(const gnss::VectorNavMessage& m, Instant arrival, world::SensorInput& out);
  void use_heading(const world::InsAttitude& attitude, gnss::GpsTime valid, Instant arrival,
                   world::SensorInput& out);
  void put_health(Instant arrival, world::SensorInput& out);

  Mounting mounting_;
  gnss::VectorNavStream stream_;
  SampleWriter writer_;
  // Last reported.
  std::uint16_t ins_status_ = 0;
  bool time_valid_ = true;
  world::ReceiverHealth reported_;
  std::optional<Instant> reported_at_;
  std::optional<gnss::GpsTime> heading_at_;
};

}  // namespace pitwall::receivers
