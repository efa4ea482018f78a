// What a NovAtel OEM7 receiver says, as plain values in the receiver's own units and axes.
//   frames WGS 84 geodetic; angles from true north, clockwise; IMU axes are the enclosure's. In
//          NovAtel's vehicle frame x is right, y forward, z up.
//   units  as named; counts of RAWIMUSX are increments over one sample (see imu_scale.hpp)
//   source OEM7 Commands and Logs Reference Manual: Binary, Description of ASCII and Binary Logs
//          with Short Headers, BESTPOS, BESTVEL, HEADING2, RAWIMUSX, CORRIMUDATAS
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "protocol/gnss/gps_time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::gnss {

inline constexpr std::size_t kLongHeaderBytes = 28, kShortHeaderBytes = 12, kCrcBytes = 4;

// The receiver's confidence in its own time (long header only).
enum class TimeStatus : std::uint8_t {
  kUnknown = 20,
  kApproximate = 60,
  kCoarse = 100,
  kFine = 160,
  kFineSteering = 180
};

struct NovatelHeader {
  std::uint16_t id = 0;
  bool short_form = false;
  std::uint8_t message_type = 0;  // bit 7: response to a command; bits 5-6: format, 0 is binary
  std::uint8_t port = 0x20;
  std::uint16_t sequence = 0;
  std::uint8_t idle_time = 0;
  std::uint8_t time_status = static_cast<std::uint8_t>(TimeStatus::kFineSteering);
  std::uint16_t week = 0;
  std::uint32_t milliseconds = 0;  // of the week
  std::uint32_t receiver_status = 0;
  std::uint16_t reserved = 0, receiver_version = 0;

  bool operator==(const NovatelHeader&) const = default;
};

constexpr GpsTime time_of(const NovatelHeader& h) {
  return gps_time(h.week, milliseconds(h.milliseconds));
}

struct BestPos {
  static constexpr std::uint16_t kId = 42;
  static constexpr std::size_t kBytes = 72;
  static constexpr bool kShort = false;

  std::uint32_t solution_status = 1, position_type = 0;
  double latitude_deg = kUnset, longitude_deg = kUnset, height_m = kUnset;  // above mean sea level
  float undulation_m = 0.0F;  // geoid above ellipsoid: ellipsoidal height = height + undulation
  std::uint32_t datum = 61;   // WGS 84
  float latitude_sigma_m = 0.0F, longitude_sigma_m = 0.0F, height_sigma_m = 0.0F;
  std::array<char, 4> station{};
  float differential_age_s = 0.0F, solution_age_s = 0.0F;
  std::uint8_t satellites_tracked = 0, satellites_used = 0, satellites_l1 = 0, satellites_multi = 0;
  std::uint8_t reserved = 0, extended_status = 0, galileo_beidou_mask = 0, gps_glonass_mask = 0;

  bool operator==(const BestPos&) const = default;
};

struct BestVel {
  static constexpr std::uint16_t kId = 99;
  static constexpr std::size_t kBytes = 44;
  static constexpr bool kShort = false;

  std::uint32_t solution_status = 1, velocity_type = 0;
  float latency_s = 0.0F;  // to be subtracted from the time of the header
  float differential_age_s = 0.0F;
  double horizontal_mps = kUnset, track_over_ground_deg = kUnset, vertical_mps = kUnset;
  float reserved = 0.0F;

  bool operator==(const BestVel&) const = default;
};

struct Heading2 {
  static constexpr std::uint16_t kId = 1335;
  static constexpr std::size_t kBytes = 48;
  static constexpr bool kShort = false;

  std::uint32_t solution_status = 1, position_type = 0;
  float baseline_m = -1.0F;  // -1: not given by this model of receiver
  float heading_deg = 0.0F;  // of the vector base antenna -> rover antenna
  float pitch_deg = 0.0F;
  float reserved = 0.0F;
  float heading_sigma_deg = 0.0F, pitch_sigma_deg = 0.0F;
  std::array<char, 4> rover_station{}, master_station{};
  std::uint8_t satellites_tracked = 0, satellites_used = 0, satellites_obs = 0,
               satellites_multi = 0;
  std::uint8_t solution_source = 0, extended_status = 0, galileo_beidou_mask = 0,
               gps_glonass_mask = 0;

  bool operator==(const Heading2&) const = default;
};

// Measurements of the IMU as they are: specific force, gravity not removed.
struct RawImuSx {
  static constexpr std::uint16_t kId = 1462;
  static constexpr std::size_t kBytes = 40;
  static constexpr bool kShort = true;
  static constexpr std::uint8_t kImuError = 0x01;  // in imu_info

  std::uint8_t imu_info = 0, imu_type = 41;  // 41: Epson G320N, the IMU of the PwrPak7D-E1
  std::uint16_t week = 0;
  double seconds = 0.0;  // of the week
  std::uint32_t imu_status = 0;
  std::int32_t z_accel = 0, minus_y_accel = 0, x_accel = 0;  // counts; the receiver negates y
  std::int32_t z_gyro = 0, minus_y_gyro = 0, x_gyro = 0;

  bool operator==(const RawImuSx&) const = default;
};

// Increments over one logging interval, corrected for gravity, the earth's rotation and estimated
// sensor errors: not a specific force.
struct CorrImuDataS {
  static constexpr std::uint16_t kId = 813;
  static constexpr std::size_t kBytes = 60;
  static constexpr bool kShort = true;

  std::uint32_t week = 0;
  double seconds = 0.0;
  double pitch_rad = kUnset, roll_rad = kUnset, yaw_rad = kUnset;  // about x, y, z; per sample
  double lateral_mps = kUnset, longitudinal_mps = kUnset, vertical_mps = kUnset;  // along x, y, z

  bool operator==(const CorrImuDataS&) const = default;
};

using NovatelMessage = std::variant<BestPos, BestVel, Heading2, RawImuSx, CorrImuDataS>;

}  // namespace pitwall::gnss
