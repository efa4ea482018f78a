// Period of the car's step.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/time.hpp"

namespace pitwall {

inline constexpr Duration kTick = milliseconds(10);

}  // namespace pitwall
