// Health of the car's computer; unset if not known.
//   units  share of all processors over the last second, 0 .. 1; MiB in use, without caches;
//          degrees Celsius of the hottest zone
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

struct ComputerHealth {
  double processor_share = kUnset, memory_mib = kUnset, temperature_c = kUnset;
};

}  // namespace pitwall::world
