// Receiver encoder of the bench: the bytes that they would send of the rig's samples, and what the
// scenario does to those bytes on their way. The same live and in lockstep.
//   in     kinds of the units, as the car file has them; faults of bytes; samples, now
//   out    bytes per unit, message by message
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hil/faults/byte_damage.hpp"
#include "hil/sensors/receiver_bytes.hpp"
#include "vehicle/world/receiver_params.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::bench {

class ReceiverSpeech {
 public:
  ReceiverSpeech(const world::Receivers& units, std::vector<faults::BenchFault> damage)
      : voices_(units), damage_(std::move(damage)) {}

  // sink(unit, bytes); what was lost altogether is not told.
  template <class Sink>
  void say(const world::SensorInput& samples, Instant now, Sink&& sink) {
    voices_.say(samples, [&](std::uint8_t unit, std::span<const std::uint8_t> message) {
      const auto arriving = damage_.pass(unit, message, now);
      if (!arriving.empty()) sink(unit, arriving);
    });
  }

 private:
  sensors::ReceiverVoices voices_;
  faults::ByteDamage damage_;
};

}  // namespace pitwall::bench
