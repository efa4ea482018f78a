// Timeout of the bench tests on a loaded machine; it is not a measured limit.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

inline constexpr Duration kTestTimeout = seconds(20);

}  // namespace pitwall::bench
