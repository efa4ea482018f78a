// Decoder of one NovAtel OEM7 receiver: bytes to samples in the units and frames of the car.
//   in     bytes with the time of their arrival, from any transport, in pieces of any size
//   out    world::SensorInput: positions, velocities, headings, IMU samples, attitudes, each at its
//          time of validity on the car's clock (gps_clock.hpp); the status of the receiver
//   frames positions WGS 84, height above the ellipsoid; IMU in Body (x forward, y left, z up) by
//          the mounting. The receiver's own attitude is that of its vehicle frame, which its
//          configuration (SETINSROTATION) defines in the car
//   units  SI and radians
//   errors counters per kind; a message is used as a whole or not at all
//   source OEM7 Commands and Logs Reference Manual. The specific force comes from RAWIMUX and
//          RAWIMUSX. In the CORRIMU logs gravity is removed with the receiver's own attitude, and
//          on a bank of 20 degrees it is the larger part of the signal, so they are counted as
//          unused. BESTVEL has no accuracy.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "protocol/gnss/novatel_codec.hpp"
#include "protocol/gnss/novatel_stream.hpp"
#include "vehicle/receivers/counters.hpp"
#include "vehicle/receivers/mounting.hpp"
#include "vehicle/receivers/sample_writer.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::receivers {

class NovatelOem7 {
 public:
  NovatelOem7(std::uint8_t unit, Duration least_delay, const Mounting& mounting = kAsNovatel)
      : mounting_(mounting), writer_(unit, least_delay) {}

  void feed(std::span<const std::uint8_t> bytes, Instant arrival, world::SensorInput& out);

  Counters counters() const;

 private:
  struct Arrived {
    gnss::NovatelHeader header;
    Instant at{};
    world::SensorInput& out;
  };

  void take(const gnss::NovatelFrame& frame, Instant arrival, world::SensorInput& out);
  void use(const gnss::BestPos& m, const Arrived& a);
  void use(const gnss::BestVel& m, const Arrived& a);
  void use(const gnss::RxStatus& m, const Arrived& a);
  void use(const gnss::Time& m, const Arrived& a);
  void use(const gnss::InsPvaX& m, const Arrived& a);
  void use(const gnss::InsAttX& m, const Arrived& a);
  // HEADING2 and DUALANTENNAHEADING, RAWIMUX and RAWIMUSX, INSPVA and INSPVAS have the same
  // content.
  template <class Heading>
  void use_heading(const Heading& m, const Arrived& a);
  template <class RawImu>
  void use_imu(const RawImu& m, const Arrived& a);
  template <class Attitude>
  void use_attitude(const Attitude& m, const Arrived& a, const world::InsAttitude& sigmas);
  void use(const gnss::Heading2& m, const Arrived& a) { use_heading(m, a); }
  void use(const gnss::DualAntennaHeading& m, const Arrived& a) { use_heading(m, a); }
  void use(const gnss::RawImuSx& m, const Arrived& a) { use_imu(m, a); }
  void use(const gnss::RawImuX& m, const Arrived& a) { use_imu(m, a); }
  void use(const gnss::InsPva& m, const Arrived& a) { use_attitude(m, a, {}); }
  void use(const gnss::InsPvaS& m, const Arrived& a) { use_attitude(m, a, {}); }
  template <class Message>
  void use(const Message&, const Arrived&) {
    ++writer_.counters().unused;
  }

  Mounting mounting_;
  gnss::NovatelStream stream_;
  SampleWriter writer_;
  world::ReceiverHealth health_;  // last reported
  double utc_offset_s_ = kUnset;
};

}  // namespace pitwall::receivers
