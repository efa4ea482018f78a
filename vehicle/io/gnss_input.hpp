// One NovAtel receiver's bytes to the samples that the car thinks in.
//   in     bytes with the time they arrived, from any transport, cut anyhow
//   out    world::SensorInput: positions, velocities, headings, IMU samples, each at the time of
//          validity on the car's clock (gps_clock.hpp)
//   frames positions WGS 84, height above the ellipsoid; IMU in Body (x forward, y left, z up) by
//          the mounting, which says along which enclosure axis each body axis points
//   units  SI and radians
//   errors counters per kind; a message is used whole or not at all
//   source the specific force comes from RAWIMUSX (1462). CORRIMUDATAS has gravity removed by the
//          receiver's own attitude, which a bank of 20 degrees makes the larger part of the signal,
//          so it is counted as unused.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/gnss/novatel_codec.hpp"
#include "protocol/gnss/novatel_stream.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "vehicle/io/gps_clock.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::io {

enum class Axis : std::uint8_t { kPlusX, kMinusX, kPlusY, kMinusY, kPlusZ, kMinusZ };

// Enclosure axis along body forward, left and up. The default is NovAtel's vehicle frame: x right,
// y forward, z up.
struct ImuMounting {
  Axis forward = Axis::kPlusY, left = Axis::kMinusX, up = Axis::kPlusZ;
};

struct GnssInputParams {
  std::uint8_t unit = 0;
  ImuMounting mounting = {};
};

struct GnssInputCounters {
  std::uint64_t used = 0;
  std::uint64_t unused = 0;        // known messages that the car does not need
  std::uint64_t unknown_id = 0;    // messages that we do not decode
  std::uint64_t undecodable = 0;   // responses, too short, not finite
  std::uint64_t time_unknown = 0;  // the receiver does not know the time yet
  std::uint64_t time_unconfirmed = 0;
  std::uint64_t out_of_range = 0;  // no place on earth, no speed of a car
  std::uint64_t imu_error = 0;     // flagged by the IMU itself, or a type without scale
};

class GnssInput {
 public:
  explicit GnssInput(const GnssInputParams& params) : params_(params) {}

  void feed(std::span<const std::uint8_t> bytes, Instant arrival, world::SensorInput& out);

  const GnssInputCounters& counters() const { return counters_; }
  const gnss::StreamCounters& stream() const { return stream_.counters(); }

 private:
  void take(const gnss::NovatelFrame& frame, Instant arrival, world::SensorInput& out);
  void use(const gnss::BestPos& m, Instant at, world::SensorInput& out);
  void use(const gnss::BestVel& m, Instant at, world::SensorInput& out);
  void use(const gnss::Heading2& m, Instant at, world::SensorInput& out);
  void use(const gnss::RawImuSx& m, Instant at, world::SensorInput& out);
  template <class Other>
  void use(const Other&, Instant, world::SensorInput&) {
    ++counters_.unused;
  }

  GnssInputParams params_;
  gnss::NovatelStream stream_;
  GpsClock clock_;
  GnssInputCounters counters_;
};

// Everything that waits in the socket, one stream of datagrams from one receiver.
std::size_t receive(transport::UdpSocket& socket, GnssInput& input, world::SensorInput& out);

}  // namespace pitwall::io
