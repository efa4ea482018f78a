// State of a car that rolls straight ahead in a gear, on level ground.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hil/plant/plant.hpp"

namespace pitwall::plant {

inline State rolling_car(double speed_mps, std::uint8_t gear, const Params& p = {}) {
  return rolling(p, standing(p, 0.0, 0.0, 0.0), speed_mps, gear);
}

}  // namespace pitwall::plant
