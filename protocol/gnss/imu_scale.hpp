// Conversion of RAWIMUSX counts to rates and specific forces and back, by type of IMU.
//   in     counts over one sample, axes of the enclosure
//   out    rad/s and m/s^2
//   source OEM7 Commands and Logs Reference Manual, RAWIMUSX, table "Raw IMU Scale Factors"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "protocol/gnss/novatel_message.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::gnss {

// One count, already multiplied by the output rate of the IMU.
struct ImuScale {
  double rate_rad_per_s = 0.0, accel_mps2 = 0.0;
};

// Epson G320N: (0.008/65536)/125 deg and (0.200/65536)/125 mG s per count, at 125 samples a second;
// the 200 Hz variant divides by its own rate, so that the rate cancels. The same holds for G370N.
constexpr std::optional<ImuScale> imu_scale(std::uint8_t imu_type) {
  constexpr double kCounts = 65'536.0, kMilliG_mps2 = kGravity_mps2 / 1'000.0;
  switch (imu_type) {
    case 41:  // Epson G320N
    case 62:  // Epson G320N, 200 Hz
      return ImuScale{from_deg(0.008 / kCounts), 0.2 / kCounts * kMilliG_mps2};
    case 61:  // Epson G370N
      return ImuScale{from_deg(0.0151515 / kCounts), 0.4 / kCounts * kMilliG_mps2};
    default:
      return std::nullopt;
  }
}

// Nearest count, saturated to the range of int32.
inline std::int32_t to_counts(double value, double one_count) {
  constexpr auto kMax = static_cast<double>(std::numeric_limits<std::int32_t>::max());
  return static_cast<std::int32_t>(
      std::fmax(-kMax, std::fmin(kMax, std::round(value / one_count))));
}

// Counts of a receiver whose enclosure is aligned with NovAtel's vehicle frame (x right, y forward,
// z up), from the motion of the car in Body (x forward, y left, z up). For the bench.
inline void count_body_motion(const std::array<double, 3>& rate_rad_per_s,
                              const std::array<double, 3>& specific_force_mps2, RawImuSx& m) {
  const ImuScale scale = imu_scale(m.imu_type).value_or(ImuScale{1.0, 1.0});
  const auto& [roll, pitch, yaw] = rate_rad_per_s;
  const auto& [forward, left, up] = specific_force_mps2;
  m.x_gyro = to_counts(-pitch, scale.rate_rad_per_s);
  m.minus_y_gyro = to_counts(-roll, scale.rate_rad_per_s);
  m.z_gyro = to_counts(yaw, scale.rate_rad_per_s);
  m.x_accel = to_counts(-left, scale.accel_mps2);
  m.minus_y_accel = to_counts(-forward, scale.accel_mps2);
  m.z_accel = to_counts(up, scale.accel_mps2);
}

}  // namespace pitwall::gnss
