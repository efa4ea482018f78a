// Actuator command: output of control, selected by safety, encoded by gateway/outbound.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

struct ActuatorCommand {
  Instant at{};                       // when it was computed
  double road_wheel_rad = kUnset;     // left positive
  double throttle_fraction = kUnset;  // 0..1
  double brake_kpa = kUnset;          // >= 0
  std::uint8_t gear = 0;
};

}  // namespace pitwall::world
