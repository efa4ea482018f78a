// Interval between packets in the tests.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kSlot = milliseconds(20);

}  // namespace pitwall::telemetry
