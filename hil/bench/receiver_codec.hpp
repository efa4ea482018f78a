// Receiver codec of the bench. The encoder makes the bytes that the receivers send for the samples
// of the rig, with the byte faults of the scenario, in live and lockstep runs. The decoder is one
// listener of lockstep, equal to the car process: it has its own receivers and keeps their samples.
//   in     kinds of the units, as in the car file; byte faults; samples or bytes, now
//   out    encoder: bytes per unit, message by message; decoder: samples since the last clear(),
//          and the arrival time of the newest byte of each unit
//   invariants
//          a listener that is not stepped loses only the samples that exceed its lists
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "hil/faults/byte_damage.hpp"
#include "hil/sensors/receiver_bytes.hpp"
#include "vehicle/receivers/receiver.hpp"
#include "vehicle/world/receiver.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::bench {

class ReceiverEncoder {
 public:
  ReceiverEncoder(const world::Receivers& units, std::vector<faults::BenchFault> damage)
      : encoders_(units), damage_(std::move(damage)) {}

  // Calls sink(unit, bytes) for each message; not for a message that is lost entirely.
  template <class Sink>
  void encode(const world::SensorInput& samples, Instant now, Sink&& sink) {
    encoders_.encode(samples, [&](std::uint8_t unit, std::span<const std::uint8_t> message) {
      const auto arriving = damage_.pass(unit, message, now);
      if (!arriving.empty()) sink(unit, arriving);
    });
  }

 private:
  sensors::ReceiverEncoders encoders_;
  faults::ByteDamage damage_;
};

class ReceiverDecoder {
 public:
  explicit ReceiverDecoder(const world::Receivers& units)
      : receivers_{receivers::Receiver{0, units[0]}, receivers::Receiver{1, units[1]}} {}

  void receive(std::uint8_t unit, std::span<const std::uint8_t> bytes, Instant at) {
    receivers_[unit].feed(bytes, at, samples_);
    byte_at_[unit] = at;
  }

  const world::SensorInput& samples() const { return samples_; }
  void clear() { samples_ = {}; }
  const std::array<std::optional<Instant>, world::kGnssUnits>& byte_at() const { return byte_at_; }
  receivers::Counters counters(std::size_t unit) const { return receivers_[unit].counters(); }
  std::array<world::ReceiverTraffic, world::kGnssUnits> traffic() const {
    return {receivers::traffic_of(counters(0)), receivers::traffic_of(counters(1))};
  }

 private:
  std::array<receivers::Receiver, world::kGnssUnits> receivers_;
  world::SensorInput samples_;
  std::array<std::optional<Instant>, world::kGnssUnits> byte_at_{};
};

}  // namespace pitwall::bench
