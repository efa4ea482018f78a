// Binary output message of a VectorNav VN-310: the configured groups and fields as plain values in
// the units and axes of the sensor.
//   frames WGS 84 geodetic; yaw from true north, clockwise; sensor body x forward, y right, z down;
//          acceleration is the specific force (at rest -g along z)
//   units  as named; times are nanoseconds of GPS time since 1980-01-06 unless stated otherwise
//   invariants
//          a value is set if its bit is set in `fields`; all others are unset
//   source VectorNav binary output protocol: VN-100 User Manual UM001 v2.22, section 4.3 (packet);
//          VectorNav SDK 0.99, BinaryMeasurementDefinitions.hpp (groups, bits, sizes)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::gnss {

// In the order of the bits in the group byte.
enum class VectorNavGroup : std::uint8_t { kCommon, kTime, kImu, kGnss1, kAttitude, kIns, kGnss2 };
inline constexpr std::size_t kVectorNavGroups = 7;

// Field of a group by its bit number.
struct VectorNavField {
  VectorNavGroup group;
  unsigned bit;
};

// Configuration of an output message: a field mask per group. It defines the layout of the message.
struct VectorNavOutput {
  std::array<std::uint32_t, kVectorNavGroups> fields{};

  constexpr std::uint32_t& of(VectorNavGroup g) { return fields[static_cast<std::size_t>(g)]; }
  constexpr std::uint32_t of(VectorNavGroup g) const { return fields[static_cast<std::size_t>(g)]; }
  constexpr bool has(VectorNavField f) const { return (of(f.group) >> f.bit & 1U) != 0; }
  constexpr VectorNavOutput with(VectorNavField f) const {
    VectorNavOutput more = *this;
    more.of(f.group) |= 1U << f.bit;
    return more;
  }
  bool operator==(const VectorNavOutput&) const = default;
};

namespace vectornav {
inline constexpr VectorNavField kTimeStartup{VectorNavGroup::kTime, 0};
inline constexpr VectorNavField kTimeGps{VectorNavGroup::kTime, 1};
inline constexpr VectorNavField kTimeGpsTow{VectorNavGroup::kTime, 2};
inline constexpr VectorNavField kTimeGpsWeek{VectorNavGroup::kTime, 3};
inline constexpr VectorNavField kTimeUtc{VectorNavGroup::kTime, 6};
inline constexpr VectorNavField kTimeStatus{VectorNavGroup::kTime, 9};
inline constexpr VectorNavField kImuStatus{VectorNavGroup::kImu, 0};
inline constexpr VectorNavField kAccel{VectorNavGroup::kImu, 9};
inline constexpr VectorNavField kAngularRate{VectorNavGroup::kImu, 10};
inline constexpr VectorNavField kYawPitchRoll{VectorNavGroup::kAttitude, 1};
inline constexpr VectorNavField kYawPitchRollUncertainty{VectorNavGroup::kAttitude, 8};
inline constexpr VectorNavField kInsStatus{VectorNavGroup::kIns, 0};
inline constexpr VectorNavField kInsPosition{VectorNavGroup::kIns, 1};
inline constexpr VectorNavField kInsVelocity{VectorNavGroup::kIns, 4};  // north, east, down
inline constexpr VectorNavField kInsPositionUncertainty{VectorNavGroup::kIns, 9};
inline constexpr VectorNavField kInsVelocityUncertainty{VectorNavGroup::kIns, 10};
inline constexpr VectorNavField kGnssTow{VectorNavGroup::kGnss1, 1};
inline constexpr VectorNavField kGnssWeek{VectorNavGroup::kGnss1, 2};
inline constexpr VectorNavField kGnssSatellites{VectorNavGroup::kGnss1, 3};
inline constexpr VectorNavField kGnssFix{VectorNavGroup::kGnss1, 4};
inline constexpr VectorNavField kGnssPosition{VectorNavGroup::kGnss1, 5};
inline constexpr VectorNavField kGnssVelocity{VectorNavGroup::kGnss1, 7};  // north, east, down
inline constexpr VectorNavField kGnssPositionUncertainty{VectorNavGroup::kGnss1, 9};
inline constexpr VectorNavField kGnssVelocityUncertainty{VectorNavGroup::kGnss1, 10};
inline constexpr VectorNavField kGnssTimeInfo{VectorNavGroup::kGnss1, 12};
inline constexpr VectorNavField kGnssStatus{VectorNavGroup::kGnss1, 17};
// Bits of the common group, which repeats fields of the other groups.
inline constexpr VectorNavField kCommonTimeGps{VectorNavGroup::kCommon, 1};
inline constexpr VectorNavField kCommonYawPitchRoll{VectorNavGroup::kCommon, 3};
inline constexpr VectorNavField kCommonAngularRate{VectorNavGroup::kCommon, 5};
inline constexpr VectorNavField kCommonPosition{VectorNavGroup::kCommon, 6};
inline constexpr VectorNavField kCommonVelocity{VectorNavGroup::kCommon, 7};
inline constexpr VectorNavField kCommonAccel{VectorNavGroup::kCommon, 8};
inline constexpr VectorNavField kCommonInsStatus{VectorNavGroup::kCommon, 12};

// Bits of ins_status. The lowest two bits are the mode.
inline constexpr std::uint16_t kInsModeMask = 0x0003, kInsNotTracking = 0, kInsAligning = 1,
                               kInsTracking = 2, kInsGnssLost = 3;
inline constexpr std::uint16_t kInsGnssFix = 0x0004, kInsImuError = 0x0010,
                               kInsMagPressureError = 0x0020, kInsGnssError = 0x0040;
// Bits of time_status.
inline constexpr std::uint8_t kTowValid = 0x01, kDateValid = 0x02, kUtcValid = 0x04;
// Values of VectorNavSolution::fix.
inline constexpr std::uint8_t kNoFix = 0, kTimeOnly = 1, kFix2d = 2, kFix3d = 3, kFixSbas = 4,
                              kRtkFloat = 7, kRtkFixed = 8;
}  // namespace vectornav

struct VectorNavUtc {
  std::int8_t year = 0;  // since 2000
  std::uint8_t month = 0, day = 0, hour = 0, minute = 0, second = 0;
  std::uint16_t ms = 0;
};

namespace detail {
inline constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
}
using VectorNavTriple = std::array<float, 3>;
inline constexpr VectorNavTriple kUnsetTriple{detail::kNone, detail::kNone, detail::kNone};

// Unfiltered solution of one of the two internal GNSS receivers.
struct VectorNavSolution {
  VectorNavUtc utc;
  std::uint64_t tow_ns = 0;
  std::uint16_t week = 0;
  std::uint8_t satellites = 0, fix = 0;
  double latitude_deg = kUnset, longitude_deg = kUnset, altitude_m = kUnset;  // above the ellipsoid
  std::array<double, 3> ecef_m{kUnset, kUnset, kUnset};
  VectorNavTriple ned_mps = kUnsetTriple, ecef_mps = kUnsetTriple;
  VectorNavTriple position_u_m = kUnsetTriple;  // one sigma: north, east, down
  float velocity_u_mps = detail::kNone, time_u_s = detail::kNone;
  std::uint8_t time_status = 0;
  std::int8_t leap_s = 0;
  std::array<float, 7> dilution{};  // geometric, position, time, vertical, horizontal, north, east
  std::uint16_t status = 0;
  double altitude_msl_m = kUnset;
};

struct VectorNavMessage {
  VectorNavOutput output;

  std::uint64_t time_startup_ns = 0, time_gps_ns = 0, tow_ns = 0;
  std::uint64_t since_sync_in_ns = 0, since_pulse_ns = 0;
  std::uint16_t week = 0;
  VectorNavUtc utc;
  std::uint32_t sync_in_count = 0, sync_out_count = 0;
  std::uint8_t time_status = 0;

  std::uint16_t imu_status = 0;
  VectorNavTriple raw_mag_gauss = kUnsetTriple, raw_accel_mps2 = kUnsetTriple,
                  raw_rate_rad_per_s = kUnsetTriple;  // not corrected by the filter's biases
  float temperature_c = detail::kNone, pressure_kpa = detail::kNone;
  float delta_time_s = detail::kNone;
  VectorNavTriple delta_theta_deg = kUnsetTriple, delta_velocity_mps = kUnsetTriple;
  VectorNavTriple mag_gauss = kUnsetTriple, accel_mps2 = kUnsetTriple,
                  rate_rad_per_s = kUnsetTriple;
  std::uint16_t saturation = 0;

  std::uint16_t attitude_status = 0;
  VectorNavTriple yaw_pitch_roll_deg = kUnsetTriple;
  std::array<float, 4> quaternion{};  // x, y, z, scalar
  std::array<float, 9> cosines{};
  VectorNavTriple mag_ned_gauss = kUnsetTriple, accel_ned_mps2 = kUnsetTriple;
  VectorNavTriple linear_body_mps2 = kUnsetTriple, linear_ned_mps2 = kUnsetTriple;
  VectorNavTriple yaw_pitch_roll_u_deg = kUnsetTriple;  // one sigma
  float attitude_u_deg = detail::kNone;

  std::uint16_t ins_status = 0;
  double latitude_deg = kUnset, longitude_deg = kUnset, altitude_m = kUnset;
  std::array<double, 3> ecef_m{kUnset, kUnset, kUnset};
  VectorNavTriple body_mps = kUnsetTriple, ned_mps = kUnsetTriple, ecef_mps = kUnsetTriple;
  VectorNavTriple mag_ecef_gauss = kUnsetTriple, accel_ecef_mps2 = kUnsetTriple,
                  linear_ecef_mps2 = kUnsetTriple;
  float position_u_m = detail::kNone, velocity_u_mps = detail::kNone;  // one sigma

  std::array<VectorNavSolution, 2> gnss;  // antenna A, antenna B
};

}  // namespace pitwall::gnss
