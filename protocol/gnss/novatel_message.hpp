// Messages of a NovAtel OEM7 receiver as plain values, in the units and axes of the receiver.
//   frames WGS 84 geodetic; angles from true north, clockwise; IMU axes are the enclosure's. In
//          NovAtel's vehicle frame x is right, y forward, z up; roll is right-handed about y,
//          pitch about x.
//   units  as named; counts of RAWIMU* are increments over one sample (see imu_scale.hpp)
//   source OEM7 Commands and Logs Reference Manual, the pages of these logs; the layouts agree with
//          NovAtel's own driver (novatel_oem7_driver, oem7_messages.h) where it has them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "protocol/gnss/field_kind.hpp"
#include "protocol/gnss/gps_time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::gnss {

inline constexpr std::size_t kLongHeaderBytes = 28, kShortHeaderBytes = 12, kCrcBytes = 4;

// Quality of the receiver's own time (long header only).
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
  std::uint8_t idle_time = 0;  // half per cent
  std::uint8_t time_status = static_cast<std::uint8_t>(TimeStatus::kFineSteering);
  std::uint16_t week = 0;
  std::uint32_t milliseconds = 0;  // of the week
  std::uint32_t receiver_status = 0;
  std::uint16_t reserved = 0, receiver_version = 0;

  bool operator==(const NovatelHeader&) const = default;
};

// True if week and time of week are valid. A short header has no time status: there the week is
// zero until the receiver has the time.
constexpr bool has_time(const NovatelHeader& h) {
  const bool status = h.short_form || h.time_status >= static_cast<int>(TimeStatus::kCoarse);
  return status && is_week(h.week) && h.milliseconds < kWeek_ms;
}

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

// The same position on the UTM grid.
struct BestUtm {
  static constexpr std::uint16_t kId = 726;
  static constexpr std::size_t kBytes = 80;
  static constexpr bool kShort = false;

  std::uint32_t solution_status = 1, position_type = 0;
  std::uint32_t zone_number = 0, zone_letter = '*';  // '*': outside the grid
  double northing_m = kUnset, easting_m = kUnset, height_m = kUnset;
  float undulation_m = 0.0F;
  std::uint32_t datum = 61;
  float northing_sigma_m = 0.0F, easting_sigma_m = 0.0F, height_sigma_m = 0.0F;
  std::array<char, 4> station{};
  float differential_age_s = 0.0F, solution_age_s = 0.0F;
  std::uint8_t satellites_tracked = 0, satellites_used = 0, satellites_l1 = 0, satellites_multi = 0;
  std::uint8_t reserved = 0, extended_status = 0, galileo_beidou_mask = 0, gps_glonass_mask = 0;

  bool operator==(const BestUtm&) const = default;
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
  float baseline_m = -1.0F;  // -1: this receiver model does not report it
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

// HEADING2 for a receiver with two antennas, without a rover.
struct DualAntennaHeading {
  static constexpr std::uint16_t kId = 2042;
  static constexpr std::size_t kBytes = 44;
  static constexpr bool kShort = false;

  std::uint32_t solution_status = 1, position_type = 0;
  float baseline_m = -1.0F;
  float heading_deg = 0.0F;  // of the vector primary antenna -> secondary antenna
  float pitch_deg = 0.0F;
  float reserved = 0.0F;
  float heading_sigma_deg = 0.0F, pitch_sigma_deg = 0.0F;
  std::array<char, 4> station{};
  std::uint8_t satellites_tracked = 0, satellites_used = 0, satellites_obs = 0,
               satellites_multi = 0;
  std::uint8_t solution_source = 0, extended_status = 0, galileo_beidou_mask = 0,
               gps_glonass_mask = 0;

  bool operator==(const DualAntennaHeading&) const = default;
};

// INSPVA and, with the short header, INSPVAS.
template <std::uint16_t Id, bool Short>
struct InsPvaOf {
  static constexpr std::uint16_t kId = Id;
  static constexpr std::size_t kBytes = 88;
  static constexpr bool kShort = Short;

  std::uint32_t week = 0;
  double seconds = 0.0;                                                     // of the week
  double latitude_deg = kUnset, longitude_deg = kUnset, height_m = kUnset;  // above the ellipsoid
  double north_mps = kUnset, east_mps = kUnset, up_mps = kUnset;
  double roll_deg = kUnset, pitch_deg = kUnset, azimuth_deg = kUnset;
  std::uint32_t ins_status = 0;

  bool operator==(const InsPvaOf&) const = default;
};
using InsPva = InsPvaOf<507, false>;
using InsPvaS = InsPvaOf<508, true>;

// INSPVA with standard deviations. Unlike in INSPVA, the height is above mean sea level.
struct InsPvaX {
  static constexpr std::uint16_t kId = 1465;
  static constexpr std::size_t kBytes = 126;
  static constexpr bool kShort = false;

  std::uint32_t ins_status = 0, position_type = 0;
  double latitude_deg = kUnset, longitude_deg = kUnset, height_m = kUnset;
  float undulation_m = 0.0F;
  double north_mps = kUnset, east_mps = kUnset, up_mps = kUnset;
  double roll_deg = kUnset, pitch_deg = kUnset, azimuth_deg = kUnset;
  float latitude_sigma_m = 0.0F, longitude_sigma_m = 0.0F, height_sigma_m = 0.0F;
  float north_sigma_mps = 0.0F, east_sigma_mps = 0.0F, up_sigma_mps = 0.0F;
  float roll_sigma_deg = 0.0F, pitch_sigma_deg = 0.0F, azimuth_sigma_deg = 0.0F;
  std::uint32_t extended_status = 0;
  std::uint16_t since_update_s = 0;  // last position or zero-velocity update

  bool operator==(const InsPvaX&) const = default;
};

// Only the attitude of INSPVAX.
struct InsAttX {
  static constexpr std::uint16_t kId = 1457;
  static constexpr std::size_t kBytes = 50;
  static constexpr bool kShort = false;

  std::uint32_t ins_status = 0, position_type = 0;
  double roll_deg = kUnset, pitch_deg = kUnset, azimuth_deg = kUnset;
  float roll_sigma_deg = 0.0F, pitch_sigma_deg = 0.0F, azimuth_sigma_deg = 0.0F;
  std::uint32_t extended_status = 0;
  std::uint16_t since_update_s = 0;

  bool operator==(const InsAttX&) const = default;
};

// RAWIMU and RAWIMUS: raw measurements of the IMU, with gravity.
template <std::uint16_t Id, bool Short>
struct RawImuOf {
  static constexpr std::uint16_t kId = Id;
  static constexpr std::size_t kBytes = 40;
  static constexpr bool kShort = Short;

  std::uint32_t week = 0;
  double seconds = 0.0;  // of the week
  std::uint32_t imu_status = 0;
  std::int32_t z_accel = 0, minus_y_accel = 0, x_accel = 0;  // counts; the receiver negates y
  std::int32_t z_gyro = 0, minus_y_gyro = 0, x_gyro = 0;

  bool operator==(const RawImuOf&) const = default;
};
using RawImu = RawImuOf<268, false>;
using RawImuS = RawImuOf<325, true>;

// RAWIMUX and RAWIMUSX: RAWIMU with the type of the IMU.
template <std::uint16_t Id, bool Short>
struct RawImuXOf {
  static constexpr std::uint16_t kId = Id;
  static constexpr std::size_t kBytes = 40;
  static constexpr bool kShort = Short;
  static constexpr std::uint8_t kImuError = 0x01;  // in imu_info

  std::uint8_t imu_info = 0, imu_type = 41;  // 41: Epson G320N, the IMU of the PwrPak7D-E1
  std::uint16_t week = 0;
  double seconds = 0.0;  // of the week
  std::uint32_t imu_status = 0;
  std::int32_t z_accel = 0, minus_y_accel = 0, x_accel = 0;  // counts; the receiver negates y
  std::int32_t z_gyro = 0, minus_y_gyro = 0, x_gyro = 0;

  bool operator==(const RawImuXOf&) const = default;
};
using RawImuX = RawImuXOf<1461, false>;
using RawImuSx = RawImuXOf<1462, true>;

// CORRIMUDATA and CORRIMUDATAS: increments over one logging interval, corrected for gravity, the
// earth's rotation and estimated sensor errors: not a specific force.
template <std::uint16_t Id, bool Short>
struct CorrImuDataOf {
  static constexpr std::uint16_t kId = Id;
  static constexpr std::size_t kBytes = 60;
  static constexpr bool kShort = Short;

  std::uint32_t week = 0;
  double seconds = 0.0;
  double pitch_rad = kUnset, roll_rad = kUnset, yaw_rad = kUnset;  // about x, y, z; per sample
  double lateral_mps = kUnset, longitudinal_mps = kUnset, vertical_mps = kUnset;  // along x, y, z

  bool operator==(const CorrImuDataOf&) const = default;
};
using CorrImuData = CorrImuDataOf<812, false>;
using CorrImuDataS = CorrImuDataOf<813, true>;
// IMURATECORRIMUS: the same at the rate of the IMU, increments over one of its samples.
using ImuRateCorrImuS = CorrImuDataOf<1362, true>;

// CORRIMUS, the successor of CORRIMUDATAS: the sum over `samples` of the IMU; the header has the
// time.
struct CorrImuS {
  static constexpr std::uint16_t kId = 2264;
  static constexpr std::size_t kBytes = 60;
  static constexpr bool kShort = true;

  std::uint32_t samples = 0;
  double pitch_rad = kUnset, roll_rad = kUnset, yaw_rad = kUnset;
  double lateral_mps = kUnset, longitudinal_mps = kUnset, vertical_mps = kUnset;
  float reserved_1 = 0.0F;  // a recording of firmware 7.08 has a decimal number here
  std::uint32_t reserved_2 = 0;

  bool operator==(const CorrImuS&) const = default;
};

// INSSTDEV and INSSTDEVS: standard deviations of the inertial solution.
template <std::uint16_t Id, bool Short>
struct InsStdDevOf {
  static constexpr std::uint16_t kId = Id;
  static constexpr std::size_t kBytes = 52;
  static constexpr bool kShort = Short;

  float latitude_sigma_m = 0.0F, longitude_sigma_m = 0.0F, height_sigma_m = 0.0F;
  float north_sigma_mps = 0.0F, east_sigma_mps = 0.0F, up_sigma_mps = 0.0F;
  float roll_sigma_deg = 0.0F, pitch_sigma_deg = 0.0F, azimuth_sigma_deg = 0.0F;
  std::uint32_t extended_status = 0;
  std::uint16_t since_update_s = 0;  // last position or zero-velocity update
  std::uint16_t reserved_1 = 0;
  std::uint32_t reserved_2 = 0, reserved_3 = 0;

  bool operator==(const InsStdDevOf&) const = default;
};
using InsStdDev = InsStdDevOf<2051, false>;
using InsStdDevS = InsStdDevOf<2052, true>;

// Configured translation (metres) or rotation (degrees).
struct InsOffset {
  static constexpr std::size_t kBytes = 36;

  std::uint32_t kind = 0;   // translation: 1 ANT1, 2 ANT2, 4 USER; rotation: 11 RBV
  std::uint32_t frame = 0;  // 0 IMU body, 1 vehicle
  float x = 0.0F, y = 0.0F, z = 0.0F;
  float x_sigma = 0.0F, y_sigma = 0.0F, z_sigma = 0.0F;
  std::uint32_t source = 0;

  bool operator==(const InsOffset&) const = default;
};

// INSCONFIG, configuration of the inertial solution: lever arms, rotations, profile.
struct InsConfig {
  static constexpr std::uint16_t kId = 1945;
  static constexpr std::size_t kBytes = 60 + 2 * (4 + kMostEntries * InsOffset::kBytes);
  static constexpr bool kShort = false;

  std::uint32_t imu_type = 0;
  std::uint8_t mapping = 0;
  std::uint8_t alignment_speed_dmps = 0;  // lowest speed for an alignment, 0.1 m/s
  std::uint16_t heave_window_s = 0;
  std::uint32_t profile = 0, enabled_updates = 0, alignment_mode = 0;
  std::uint32_t output_frame = 0, output_direction = 0;  // of the relative solution
  std::uint32_t receiver_status = 0;
  std::uint8_t seed_enabled = 0, seed_validation = 0;
  std::uint16_t reserved_1 = 0;
  std::array<std::uint32_t, 6> reserved{};
  std::uint32_t translations = 0;  // number of entries in use
  std::array<InsOffset, kMostEntries> translation{};
  std::uint32_t rotations = 0;
  std::array<InsOffset, kMostEntries> rotation{};

  bool operator==(const InsConfig&) const = default;
};

struct StatusWord {
  std::uint32_t bits = 0, priority_mask = 0, set_mask = 0, clear_mask = 0;

  bool operator==(const StatusWord&) const = default;
};

struct RxStatus {
  static constexpr std::uint16_t kId = 93;
  static constexpr std::size_t kBytes = 88;
  static constexpr bool kShort = false;

  std::uint32_t error = 0;
  std::uint32_t words = 5;  // number of status words: five, or four in early firmware
  StatusWord receiver, auxiliary_1, auxiliary_2, auxiliary_3, auxiliary_4;

  bool operator==(const RxStatus&) const = default;
};

struct Time {
  static constexpr std::uint16_t kId = 101;
  static constexpr std::size_t kBytes = 44;
  static constexpr bool kShort = false;

  std::uint32_t clock_status = 3;                     // 0 valid, 3 invalid
  double offset_s = kUnset, offset_sigma_s = kUnset;  // of the receiver's clock from GPS time
  double utc_offset_s = kUnset;                       // UTC = GPS time + this (-18 since 2017)
  std::uint32_t utc_year = 0;
  std::uint8_t utc_month = 0, utc_day = 0, utc_hour = 0, utc_minute = 0;
  std::uint32_t utc_ms = 0;      // of the minute
  std::uint32_t utc_status = 0;  // 1 valid, 2 leap second not yet known

  bool operator==(const Time&) const = default;
};

using NovatelMessage =
    std::variant<BestPos, BestVel, Heading2, RawImuSx, CorrImuDataS, DualAntennaHeading, InsPva,
                 InsPvaS, InsPvaX, InsAttX, RawImu, RawImuS, RawImuX, CorrImuData, CorrImuS,
                 RxStatus, Time, BestUtm, ImuRateCorrImuS, InsStdDev, InsStdDevS, InsConfig>;

}  // namespace pitwall::gnss
