// Track flags by their values in the registry field flags.track.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pitwall::state {

inline constexpr double kRed = 1, kYellow = 3, kGreen = 4, kWaving = 5, kUnknownFlag = 7;

}  // namespace pitwall::state
