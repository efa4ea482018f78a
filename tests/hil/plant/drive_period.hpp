// Sampling period of a recorded drive.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pitwall::plant {

inline constexpr double kPeriod_s = 0.04;

}  // namespace pitwall::plant
