// Encoder of receiver streams: from samples to the bytes that a NovAtel OEM7 or a VectorNav VN-310
// sends. Used by the live and the lockstep bench.
//   in     samples of sensors.hpp, `at` in scenario time
//   out    whole messages
//   frames IMU: Body (x forward, y left, z up) to NovAtel's vehicle frame (x right, y forward, z
//          up), to VectorNav's body frame (x forward, y right, z down)
//   invariants
//          values without a field in the messages of a receiver are not sent: NovAtel's BESTVEL has
//          no deviation; VectorNav has no age of corrections and no heading of an antenna baseline
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/gnss/novatel_codec.hpp"
#include "protocol/gnss/vectornav_message.hpp"
#include "vehicle/world/receiver.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::sensors {

// GPS week of scenario time zero. Any week is possible except 0, which means "unknown".
inline constexpr std::uint16_t kScenarioGpsWeek = 2'190;
inline constexpr double kLeapSeconds = 18.0;  // GPS time minus UTC, since 2017

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

// Encoder of one VectorNav. One message holds position and velocity of an epoch, so the encoder
// stores the position until the velocity comes. Compass and health go into the status words of
// other messages.
class VectorNavEncoder {
 public:
  ReceiverBytes encode(const world::GnssPosition& sample);  // empty: stored
  // Empty if the stored position has another time.
  ReceiverBytes encode(const world::GnssVelocity& sample);
  ReceiverBytes encode(const world::GnssHeading& sample);  // empty: stores the compass state
  ReceiverBytes encode(const world::ImuSample& sample);
  ReceiverBytes encode(const world::InsAttitude& sample);
  ReceiverBytes encode(const world::ReceiverHealth& sample);  // empty: stored

 private:
  world::GnssPosition position_;
  bool compass_ = false;
  world::ReceiverHealth health_;
};

// Encoders of all units of the car, each for its kind of receiver.
class ReceiverEncoders {
 public:
  explicit ReceiverEncoders(const world::Receivers& units) : units_(units) {}

  // Calls sink(unit, bytes) for each message. The IMU is first, because its latency is shortest.
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
