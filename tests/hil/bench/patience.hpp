// How long these tests wait for a loaded machine; nothing is measured with it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

inline constexpr Duration kPatience = seconds(20);

}  // namespace pitwall::bench
