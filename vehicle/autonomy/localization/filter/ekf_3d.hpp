// Spatial error-state extended Kalman filter: position, attitude, velocity, biases of gyro and
// accelerometer, driven by the IMU, and slowly varying errors: the position error of each receiver,
// the scale factors of the yaw gyro and of the lateral accelerometer. Its vectors and matrices are
// in ekf_3d_errors.hpp.
//   state  p [m] and v [m/s] of the centre of gravity in Map, q Body to Map, bg [rad/s], ba
//          [m/s^2], w_u per receiver: its slowly varying position error as a share of the sigma
//          that it reports, s and a: relative errors of the yaw rate and the lateral force
//   errors of the state, in this order: dp, phi (rotation vector in Map, R = exp(phi) R_mean), dv,
//          dbg, dba, dw_0, dw_1, ds, da: 23 numbers
//   invariants
//          p' = v    v' = R force + g    force = f - ba - e_y a f_y
//          R' = R [rate]x    rate = w - bg - e_z s w_z
//          bg' = ba' = white noise    s' = a' = 0
//          w_u' = -w_u / tau + white noise of variance 2 / tau (Gauss-Markov of unit variance),
//          partly correlated between the receivers
//          the IMU is interpolated linearly between its samples and held after the last one; its
//          lever arm is corrected with the change of the rates between the samples
//   source Sola, Quaternion kinematics for the error-state Kalman filter (2017), section 7 (global
//          angular error); Brown and Hwang, Random Signals, section 5.9 (coloured noise as states)
//   errors none: unset values of an IMU sample are filled in
//   cost   a step about 2 us; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "vehicle/autonomy/localization/filter/measurement.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::localization {

inline constexpr int kErrors = 23;
enum ErrorIndex : int {
  kDp = 0,
  kPhi = 3,
  kDv = 6,
  kDbg = 9,
  kDba = 12,
  kDw = 15,
  kDs = 21,
  kDa = 22
};

struct SpatialParams {
  // Spectral densities: sigma grows with the square root of time.
  double gyro_rad_per_sqrt_s = kUnset;
  double accel_mps_per_sqrt_s = kUnset;
  double gyro_bias_rad_per_s_sqrt_s = kUnset;
  double accel_bias_mps2_sqrt_s = kUnset;
  double gyro_bias_start_rad_per_s = kUnset;  // sigma at the start
  double accel_bias_start_mps2 = kUnset;
  double gyro_scale_start = kUnset;
  double accel_scale_start = kUnset;
  std::array<double, 3> gate_nis{kUnset, kUnset, kUnset};  // 4..100: 1, 2, 3 degrees of freedom
  double reacquire_s = kUnset;
  // Receivers. This share of the sigma that a receiver reports for its position varies slowly.
  double position_wander_share = kUnset;
  double position_wander_s = kUnset;         // correlation time
  double position_wander_together = kUnset;  // correlation of the two receivers
  double position_sigma_floor_m = kUnset;    // white noise, added to the reported sigma
  double velocity_sigma_mps = kUnset;        // if the receiver reports none
  double vertical_velocity_sigma_mps = kUnset;
  double heading_sigma_floor_rad = kUnset;
  double heading_correlation_s = kUnset;  // like model_correlation_s
  // Models of the car and the road. Their errors are correlated in time; each sigma is that of the
  // error itself, and a stream of them counts as one independent sample in two correlation times.
  double model_correlation_s = kUnset;
  double wheel_sigma_mps = kUnset;
  double wheel_sigma_per_speed = kUnset;  // share of the speed (slip, tyre growth)
  double slip_sigma_mps = kUnset;         // lateral speed of the tyre model
  double cg_to_rear_m = kUnset;
  double rear_slip_rad_per_mps2 = kUnset;  // rear slip angle per lateral acceleration
  double road_tilt_sigma_rad = kUnset;     // car relative to the map's surface
  double road_height_sigma_m = kUnset;
  double road_normal_sigma_mps = kUnset;     // speed normal to the surface
  double cg_height_m = kUnset;               // above the surface of the map
  double attitude_sigma_floor_rad = kUnset;  // attitude that a receiver reports
};

// IMU input at one instant, including the biases.
struct Drive {
  std::array<double, 3> rate_rad_per_s{}, force_mps2{};
};

// Consecutive refusals of one kind of measurement.
struct Streak {
  Instant since{};
  std::uint32_t count = 0;
};
enum class StreakOf : std::uint8_t { kPosition, kVelocity, kHeading };
inline constexpr std::size_t kStreaks = 3;

// Models with time-correlated errors, each with the time of its last use.
enum class ModelOf : std::uint8_t {
  kWheels,
  kSlip,
  kTilt,
  kHeight,
  kNormal,
  kAttitude,
  kHeading0,
  kHeading1
};
inline constexpr std::size_t kModels = 8;

// Plain arrays, so that it is trivially copyable.
struct SpatialBelief {
  Instant at{};
  std::array<double, 3> position_m{};
  std::array<double, 4> attitude{1.0, 0.0, 0.0, 0.0};  // w, x, y, z
  std::array<double, 3> velocity_mps{};
  std::array<double, 3> gyro_bias_rad_per_s{}, accel_bias_mps2{};
  std::array<std::array<double, 3>, world::kGnssUnits> wander{};
  std::array<double, static_cast<std::size_t>(kErrors* kErrors)> covariance{};
  double gyro_scale = 0.0, accel_scale = 0.0;  // for the yaw rate, for the lateral force
  Drive now;                                   // at `at`
  // Newest sample at or before `at`, moved to the centre of gravity except for the change of its
  // rates.
  Drive last_imu;
  LeverArm last_imu_arm;
  Instant last_imu_at{};
  std::uint8_t last_imu_unit = 0;
  bool imu_received = false;
  bool imu_is_substitute = false;  // the sample is from a model, not from an IMU
  std::array<double, world::kGnssUnits> unit_sigma_m{};  // last reported sigma
  std::array<Streak, kStreaks> streaks{};
  std::array<Instant, kModels> model_at{};
};

// Advances the belief to `to` with the IMU as far as it is known.
void advance(SpatialBelief& b, const SpatialParams& p, Instant to, const Measurement* next_imu);
// Takes a kImu measurement at its instant.
void apply_imu(SpatialBelief& b, const SpatialParams& p, const Measurement& m);

}  // namespace pitwall::localization
