// The spatial error-state extended Kalman filter: position, attitude, velocity, biases of gyro and
// accelerometer, driven by the IMU, and what wanders slowly beside them: the error of each
// receiver's position, the scales of the yaw gyro and of the lateral accelerometer. As vectors and
// matrices: ekf_3d_errors.hpp.
//   state  p [m] and v [m/s] of the centre of gravity in Map, q Body to Map, bg [rad/s], ba
//          [m/s^2], w_u per receiver: its wandering position error as a share of the sigma that it
//          reports, s and a: relative errors of the yaw rate and the lateral force
//   errors of the state, in this order: dp, phi (rotation vector in Map, R = exp(phi) R_mean), dv,
//          dbg, dba, dw_0, dw_1, ds, da: 23 numbers
//   invariants
//          p' = v    v' = R force + g    force = f - ba - e_y a f_y
//          R' = R [rate]x    rate = w - bg - e_z s w_z
//          bg' = ba' = white noise    s' = a' = 0
//          w_u' = -w_u / tau + white noise of variance 2 / tau (Gauss-Markov of unit variance),
//          partly the same for both receivers
//          the IMU is linear between its samples, held after the last one; its place on the car is
//          taken out with the change of the rates between the samples
//   source Sola, Quaternion kinematics for the error-state Kalman filter (2017), section 7 (global
//          angular error); Brown and Hwang, Random Signals, section 5.9 (coloured noise as states)
//   errors none: what is unset in an IMU sample is filled in
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
  // Receivers. Of the sigma that one reports for its position this share wanders slowly.
  double position_wander_share = kUnset;
  double position_wander_s = kUnset;         // correlation time
  double position_wander_together = kUnset;  // correlation of the two receivers
  double position_sigma_floor_m = kUnset;    // white, added to what it reports
  double velocity_sigma_mps = kUnset;        // where it does not say
  double vertical_velocity_sigma_mps = kUnset;
  double heading_sigma_floor_rad = kUnset;
  double heading_correlation_s = kUnset;  // as model_correlation_s
  // Models of the car and the road. Their errors last; each sigma is that of the error itself, and
  // a stream of them is worth one independent sample in two correlation times.
  double model_correlation_s = kUnset;
  double wheel_sigma_mps = kUnset;
  double wheel_sigma_per_speed = kUnset;  // share of the speed (slip, tyre growth)
  double slip_sigma_mps = kUnset;         // of the lateral speed by the tyre model
  double cg_to_rear_m = kUnset;
  double rear_slip_rad_per_mps2 = kUnset;  // rear slip angle per lateral acceleration
  double road_tilt_sigma_rad = kUnset;     // the car against the map's surface
  double road_height_sigma_m = kUnset;
  double road_normal_sigma_mps = kUnset;     // speed across the surface
  double cg_height_m = kUnset;               // over the surface of the map
  double attitude_sigma_floor_rad = kUnset;  // of a receiver's own attitude
};

// What drives the state at one instant; biases still in it.
struct Drive {
  std::array<double, 3> rate_rad_per_s{}, force_mps2{};
};

// One kind of measurement that is refused again and again.
struct Streak {
  Instant since{};
  std::uint32_t count = 0;
};
enum class StreakOf : std::uint8_t { kPosition, kVelocity, kHeading };
inline constexpr std::size_t kStreaks = 3;

// Models whose errors last, each with when it was last taken in.
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

// A value: plain arrays, so that it is trivially copyable.
struct SpatialBelief {
  Instant at{};
  std::array<double, 3> position_m{};
  std::array<double, 4> attitude{1.0, 0.0, 0.0, 0.0};  // w, x, y, z
  std::array<double, 3> velocity_mps{};
  std::array<double, 3> gyro_bias_rad_per_s{}, accel_bias_mps2{};
  std::array<std::array<double, 3>, world::kGnssUnits> wander{};
  std::array<double, static_cast<std::size_t>(kErrors* kErrors)> covariance{};
  double gyro_scale = 0.0, accel_scale = 0.0;  // of the yaw rate, of the lateral force
  Drive now;                                   // at `at`
  Drive last_imu;  // the newest sample at or before `at`, as if at the centre of gravity but for
                   // the change of its rates
  LeverArm last_imu_arm;
  Instant last_imu_at{};
  std::uint8_t last_imu_unit = 0;
  bool imu_received = false;
  bool imu_stands_in = false;                            // the sample is no IMU's but a model's
  std::array<double, world::kGnssUnits> unit_sigma_m{};  // last reported
  std::array<Streak, kStreaks> streaks{};
  std::array<Instant, kModels> model_at{};
};

// Takes the belief to `to`, along the IMU as far as it is known.
void advance(SpatialBelief& b, const SpatialParams& p, Instant to, const Measurement* next_imu);
// Takes a kImu in, at its instant.
void hear_imu(SpatialBelief& b, const SpatialParams& p, const Measurement& m);

}  // namespace pitwall::localization
