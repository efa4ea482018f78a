// Lap length of the track in the tests of derived signals.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pitwall::state {

inline constexpr double kLap_m = 2'400.0;

}  // namespace pitwall::state
