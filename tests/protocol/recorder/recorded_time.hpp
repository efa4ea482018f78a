// Start, period and clock of the records in these tests.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/recorder/channels.hpp"

namespace pitwall::recorder {

inline constexpr Instant kStart{seconds(100).ns};
inline constexpr Duration kTick = milliseconds(20);
inline const ClockMap kClock{.utc_minus_base = seconds(1'700'000'000), .boot = "b"};

}  // namespace pitwall::recorder
