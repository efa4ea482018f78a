// What a receiver puts on its wire: samples to the bytes that a NovAtel OEM7 or a VectorNav VN-310
// would send. The benches speak with it, live and in lockstep.
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
class VectorNavVoice {
 public:
  ReceiverBytes say(const world::GnssPosition& sample);  // nothing yet
  ReceiverBytes say(const world::GnssVelocity& sample);  // nothing without a position of its time
  ReceiverBytes say(const world::GnssHeading& sample);   // nothing: whether its compass works
  ReceiverBytes say(const world::ImuSample& sample);
  ReceiverBytes say(const world::InsAttitude& sample);
  ReceiverBytes say(const world::ReceiverHealth& sample);  // nothing: in its status words

 private:
  world::GnssPosition position_;
  bool compass_ = false;
  world::ReceiverHealth health_;
};

// All units of the car, each of its kind.
class ReceiverVoices {
 public:
  explicit ReceiverVoices(const world::Receivers& units) : units_(units) {}

  // sink(unit, bytes) for each message, the IMU's first: it is the quickest.
  template <class Sink>
  void say(const world::SensorInput& samples, Sink&& sink) {
    say_list(samples.imu, sink);
    say_list(samples.positions, sink);
    say_list(samples.velocities, sink);
    say_list(samples.headings, sink);
    say_list(samples.attitudes, sink);
    say_list(samples.receivers, sink);
  }

 private:
  template <class List, class Sink>
  void say_list(const List& list, Sink& sink) {
    for (const auto& sample : list) {
      CHECK(sample.unit < units_.size());
      const bool novatel = units_[sample.unit].kind == world::ReceiverKind::kNovatelOem7;
      const ReceiverBytes bytes =
          novatel ? to_novatel(sample) : vectornavs_[sample.unit].say(sample);
      if (bytes.length > 0) sink(sample.unit, bytes.span());
    }
  }

  world::Receivers units_;
  std::array<VectorNavVoice, world::kGnssUnits> vectornavs_{};
};

}  // namespace pitwall::sensors
