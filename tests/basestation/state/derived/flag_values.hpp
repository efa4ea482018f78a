// Flags by their values in the registry fields flags.track and flags.vehicle.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pitwall::state {

inline constexpr double kRed = 1, kYellow = 3, kGreen = 4, kWaving = 5, kUnknownFlag = 7;
inline constexpr double kDefender = 9, kAttacker = 10;

}  // namespace pitwall::state
