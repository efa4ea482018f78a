// Encoder of receiver streams: samples to the bytes that a NovAtel OEM7 or a VectorNav VN-310 would
// send. Used by the live and the lockstep bench.
//   in     samples of sensors.hpp, `at` in scenario time
//   out    whole messages
//   frames IMU: Body (x forward, y left, z up) to NovAtel's vehicle frame (x right, y forward, z
//          up), to VectorNav's body frame (x forward, y right, z down)
//   invariants
//          what a kind of receiver has no field for is not said: NovAtel's BESTVEL no deviation,
//          VectorNav no age of corrections and no heading of an antenna baseline
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/gnss/novatel_codec.hpp"
#include "protocol/gnss/vectornav_message.hpp"
#include "vehicle/world/receiver_params.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::sensors {

// GPS time of scenario time zero; any week will do, and this one is not zero, which means
// "unknown".
inline constexpr std::uint16_t kScenarioGpsWeek = 2'190;
inline constexpr double kLeapSeconds = 18.0;  // GPS time is ahead of UTC, since 2017

struct ReceiverBytes {
  std::array<std::uint8_t, 2 * gnss::kMaxEncodedBytes> data{};
  std::size_t length = 0;

  std::span<const std::uint8_t> span() const { return std::span(data).first(length); }
};

ReceiverBytes to_novatel(const world::GnssPosition& sample);
ReceiverBytes to_novatel(const world::GnssVelocity& sample);
ReceiverBytes to_novatel(const world::GnssHeading& sample);
ReceiverBytes to_novatel(const world::ImuSample& sample);
ReceiverBytes to_novatel(const world::InsAttitude& sample);
ReceiverBytes to_novatel(const world::ReceiverHealth& sample);  // RXSTATUS and TIME

// One VectorNav. It says position and velocity of an epoch in one message, when both are there; so
// it remembers, and what it says of itself rides on its other messages.
class VectorNavEncoder {
 public:
  ReceiverBytes encode(const world::GnssPosition& sample);  // nothing yet
  ReceiverBytes encode(
      const world::GnssVelocity& sample);                  // nothing without a position of its time
  ReceiverBytes encode(const world::GnssHeading& sample);  // nothing: whether its compass works
  ReceiverBytes encode(const world::ImuSample& sample);
  ReceiverBytes encode(const world::InsAttitude& sample);
  ReceiverBytes encode(const world::ReceiverHealth& sample);  // nothing: in its status words

 private:
  world::GnssPosition position_;
  bool compass_ = false;
  world::ReceiverHealth health_;
};

// All units of the car, each of its kind.
class ReceiverEncoders {
 public:
  explicit ReceiverEncoders(const world::Receivers& units) : units_(units) {}

  // sink(unit, bytes) for each message, the IMU's first: it is the quickest.
  template <class Sink>
  void encode(const world::SensorInput& samples, Sink&& sink) {
    encode_list(samples.imu, sink);
    encode_list(samples.positions, sink);
    encode_list(samples.velocities, sink);
    encode_list(samples.headings, sink);
    encode_list(samples.attitudes, sink);
    encode_list(samples.receivers, sink);
  }

 private:
  template <class List, class Sink>
  void encode_list(const List& list, Sink& sink) {
    for (const auto& sample : list) {
      CHECK(sample.unit < units_.size());
      const bool novatel = units_[sample.unit].kind == world::ReceiverKind::kNovatelOem7;
      const ReceiverBytes bytes =
          novatel ? to_novatel(sample) : vectornavs_[sample.unit].encode(sample);
      if (bytes.length > 0) sink(sample.unit, bytes.span());
    }
  }

  world::Receivers units_;
  std::array<VectorNavEncoder, world::kGnssUnits> vectornavs_{};
};

}  // namespace pitwall::sensors
