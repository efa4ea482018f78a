// Decoder of one satellite receiver, NovAtel OEM7 or VectorNav: bytes in, samples out. Car,
// guardian and benches use the same one.
//   in     bytes with the time of their arrival, in pieces of any size
//   out    GNSS and IMU samples, appended to world::SensorInput
//   errors counters; no input stops it
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <variant>

#include "vehicle/receivers/counters.hpp"
#include "vehicle/receivers/novatel_oem7.hpp"
#include "vehicle/receivers/vectornav.hpp"
#include "vehicle/world/receiver.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::receivers {

class Receiver {
 public:
  Receiver(std::uint8_t unit, const world::ReceiverParams& params) : kind_(made(unit, params)) {}

  void feed(std::span<const std::uint8_t> bytes, Instant arrival, world::SensorInput& out) {
    std::visit([&](auto& receiver) { receiver.feed(bytes, arrival, out); }, kind_);
  }
  Counters counters() const {
    return std::visit([](const auto& receiver) { return receiver.counters(); }, kind_);
  }

 private:
  using Kind = std::variant<NovatelOem7, VectorNav>;
  static Kind made(std::uint8_t unit, const world::ReceiverParams& p) {
    if (p.kind == world::ReceiverKind::kVectorNav) return VectorNav{unit, p.least_delay};
    return NovatelOem7{unit, p.least_delay};
  }

  Kind kind_;
};

}  // namespace pitwall::receivers
