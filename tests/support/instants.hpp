// Instants in tests, as time since the zero of the clock.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall {

constexpr Instant at_ms(std::int64_t ms) { return Instant{} + milliseconds(ms); }
inline Instant at_s(double s) { return Instant{} + from_seconds(s); }

}  // namespace pitwall
