// Time step of the plant in the tests.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pitwall::plant {

inline constexpr double kStep_s = 0.001;

}  // namespace pitwall::plant
