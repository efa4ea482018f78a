// Infinity as a value of a signal or a limit.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace pitwall::grading {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace pitwall::grading
