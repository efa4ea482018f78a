// Time at which the console tests read the state.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::console {

inline constexpr Instant kNow{seconds(500).ns};

}  // namespace pitwall::publishers::console
