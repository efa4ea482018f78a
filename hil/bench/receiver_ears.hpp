// Receiver decoder of one node in lockstep, exactly as the car's process does: its own receivers,
// and what they gave since it last took it.
//   in     bytes of a unit with the instant they arrive
//   out    samples since the last take(); when the newest byte of each unit came
//   invariants
//          a listener that is not run loses nothing but what its lists do not hold
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "vehicle/receivers/receiver.hpp"
#include "vehicle/world/receiver_params.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::bench {

class ReceiverEars {
 public:
  explicit ReceiverEars(const world::Receivers& units)
      : receivers_{receivers::Receiver{0, units[0]}, receivers::Receiver{1, units[1]}} {}

  void hear(std::uint8_t unit, std::span<const std::uint8_t> bytes, Instant at) {
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
