// The three output messages that the car's VectorNav is configured to send. A message with another
// header is refused: a CRC-16 alone misses too many errors.
//   rates  as configured; the car expects the IMU at 100 Hz or more, the others at 10 Hz or more
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/gnss/vectornav_message.hpp"

namespace pitwall::receivers {

namespace detail {
constexpr gnss::VectorNavOutput output_of(std::initializer_list<gnss::VectorNavField> fields) {
  gnss::VectorNavOutput output;
  for (const gnss::VectorNavField field : fields) output = output.with(field);
  return output;
}
namespace vn = gnss::vectornav;
}  // namespace detail

// Measurements of the IMU.
inline constexpr gnss::VectorNavOutput kVectorNavImu = detail::output_of(
    {detail::vn::kCommonTimeGps, detail::vn::kCommonAngularRate, detail::vn::kCommonAccel});

// Fix of the first GNSS receiver at an epoch.
inline constexpr gnss::VectorNavOutput kVectorNavFix = detail::output_of(
    {detail::vn::kGnssTow, detail::vn::kGnssWeek, detail::vn::kGnssSatellites, detail::vn::kGnssFix,
     detail::vn::kGnssPosition, detail::vn::kGnssVelocity, detail::vn::kGnssPositionUncertainty,
     detail::vn::kGnssVelocityUncertainty, detail::vn::kGnssTimeInfo});

// The inertial solution.
inline constexpr gnss::VectorNavOutput kVectorNavIns =
    detail::output_of({detail::vn::kCommonTimeGps, detail::vn::kCommonYawPitchRoll,
                       detail::vn::kCommonInsStatus, detail::vn::kYawPitchRollUncertainty});

inline constexpr std::array kVectorNavOutputs{kVectorNavImu, kVectorNavFix, kVectorNavIns};

// Bit of ins_status: the heading of the two antennas is available.
inline constexpr std::uint16_t kVectorNavCompass = 0x0200;

}  // namespace pitwall::receivers
