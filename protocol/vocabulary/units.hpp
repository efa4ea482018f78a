// Unit conversions for inputs and outputs; all other code uses SI units. kUnset marks a number
// without a value.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

namespace pitwall {

inline constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kGravity_mps2 = 9.80665;  // CGPM 1901

constexpr double from_kmh(double v_kmh) { return v_kmh / 3.6; }
constexpr double to_kmh(double v_mps) { return v_mps * 3.6; }
constexpr double from_mph(double v_mph) { return v_mph * 0.44704; }
constexpr double to_mph(double v_mps) { return v_mps / 0.44704; }
constexpr double from_deg(double angle_deg) { return angle_deg * (std::numbers::pi / 180.0); }
constexpr double to_deg(double angle_rad) { return angle_rad * (180.0 / std::numbers::pi); }
constexpr double from_rpm(double n_rpm) { return n_rpm * (std::numbers::pi / 30.0); }
constexpr double to_rpm(double w_rad_per_s) { return w_rad_per_s * (30.0 / std::numbers::pi); }

// Wraps an angle to [-pi, pi]; constant time; NaN gives NaN.
inline double wrap_pi(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

}  // namespace pitwall
