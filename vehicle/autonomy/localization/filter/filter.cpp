// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/filter.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/autonomy/localization/filter/ekf_3d_model.hpp"
#include "vehicle/autonomy/localization/filter/rotation.hpp"

namespace pitwall::localization {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

static_assert(std::is_trivially_copyable_v<FilterState>);

constexpr double kStartSpeedSigma_mps = 1.0, kStartBiasSigma_rad_per_s = 0.005;
constexpr double kStartTiltSigma_rad = 0.03, kStartHeightSigma_m = 1.0;
constexpr double kStartReach_m = 5.0;  // of the arm from which a wrong heading moves the car
constexpr double kStartWider = 3.0;    // the seed's own position is taken in again as a measurement

std::array<double, 3> array(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
double root(double x) { return std::sqrt(std::max(x, 0.0)); }
double or_else(double x, double otherwise) { return std::isfinite(x) ? x : otherwise; }

Road known(const Road& r, double yaw_rad) {
  return {.x_m = or_else(r.x_m, 0.0),
          .y_m = or_else(r.y_m, 0.0),
          .height_m = or_else(r.height_m, 0.0),
          .bank_rad = or_else(r.bank_rad, 0.0),
          .climb_rad = or_else(r.climb_rad, 0.0),
          .direction_rad = or_else(r.direction_rad, yaw_rad)};
}

// On the road, heading by the yaw.
Matrix3d attitude_on(const Road& road, double yaw_rad) {
  const Vector3d up = normal_of(road);
  Vector3d ahead(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
  ahead.z() = -ahead.dot(up) / up.z();
  ahead.normalize();
  Matrix3d r;
  r << ahead, up.cross(ahead), up;
  return r;
}

PlanarBelief planar_from(const Seed& seed) {
  const Road road = known(seed.road, seed.yaw_rad);
  const double c = std::cos(seed.yaw_rad), s = std::sin(seed.yaw_rad);
  const double left_m =
      seed.arm.y_m * std::cos(road.bank_rad) + seed.arm.z_m * std::sin(road.bank_rad);
  const double sigma_m = seed.antenna_sigma_m + kStartReach_m * seed.yaw_sigma_rad;
  PlanarBelief out;
  Belief& b = out.belief;
  b.at = seed.at;
  b.mean = {seed.antenna_m[0] - c * seed.arm.x_m + s * left_m,
            seed.antenna_m[1] - s * seed.arm.x_m - c * left_m,
            seed.yaw_rad,
            seed.speed_mps,
            0.0,
            0.0};
  const std::array<double, kStates> sigma{sigma_m,
                                          sigma_m,
                                          seed.yaw_sigma_rad,
                                          kStartSpeedSigma_mps,
                                          kStartSpeedSigma_mps,
                                          kStartBiasSigma_rad_per_s};
  for (std::size_t i = 0; i < kStates; ++i) b.covariance[i * kStates + i] = square(sigma[i]);
  b.motion.bank_rad = road.bank_rad;
  return out;
}

SpatialBelief spatial_from(const Seed& seed, const SpatialParams& p) {
  const Road road = known(seed.road, seed.yaw_rad);
  const Matrix3d r = attitude_on(road, seed.yaw_rad);
  const bool has_height = std::isfinite(seed.antenna_m[2]);
  SpatialBelief b;
  b.at = seed.at;
  Vector3d at = as_vector(seed.antenna_m) - r * as_vector(seed.arm);
  if (!has_height) at.z() = road.height_m + p.cg_height_m;
  b.position_m = array(at);
  const Eigen::Quaterniond q(r);
  b.attitude = {q.w(), q.x(), q.y(), q.z()};
  b.velocity_mps = array(seed.speed_mps * r.col(0));
  Eigen::Map<ErrorMatrix> cov(b.covariance.data());
  const auto set = [&cov](ErrorIndex i, const Vector3d& sigma) {
    cov.diagonal().segment<3>(i) = sigma.cwiseAbs2();
  };
  const double sigma_m = kStartWider * seed.antenna_sigma_m + kStartReach_m * seed.yaw_sigma_rad;
  set(kDp, {sigma_m, sigma_m, has_height ? kStartWider * sigma_m : kStartHeightSigma_m});
  set(kPhi, {kStartTiltSigma_rad, kStartTiltSigma_rad, seed.yaw_sigma_rad});
  set(kDv,
      Vector3d::Constant(kStartSpeedSigma_mps + std::abs(seed.speed_mps) * seed.yaw_sigma_rad));
  set(kDbg, Vector3d::Constant(p.gyro_bias_start_rad_per_s));
  set(kDba, Vector3d::Constant(p.accel_bias_start_mps2));
  cov.diagonal().segment<6>(kDw).setOnes();
  for (int i = kDw; i < kDw + 3; ++i) cov(i, i + 3) = cov(i + 3, i) = p.position_wander_together;
  cov(kDs, kDs) = square(p.gyro_scale_start);
  cov(kDa, kDa) = square(p.accel_scale_start);
  b.model_at.fill(seed.at);
  return b;
}

double larger_axis(double xx, double yy, double xy) {
  return root(0.5 * (xx + yy + std::hypot(xx - yy, 2.0 * xy)));
}

Estimate estimate_of(const PlanarBelief& planar) {
  const Belief& b = planar.belief;
  const auto& p = b.covariance;
  Estimate e;
  e.at = b.at;
  e.position_m = {b.mean[kX], b.mean[kY], kUnset};
  e.yaw_rad = b.mean[kYaw];
  e.velocity_mps = {b.mean[kVx], b.mean[kVy], kUnset};
  e.rate_rad_per_s[2] = b.motion.yaw_rate_rad_per_s - b.mean[kBias];
  e.force_mps2 = {b.motion.fx_mps2, b.motion.fy_mps2, kUnset};
  e.gyro_bias_rad_per_s[2] = b.mean[kBias];
  e.position_sigma_m = larger_axis(p[0], p[kStates + 1], p[1]);
  e.yaw_sigma_rad = root(p[kYaw * kStates + kYaw]);
  e.speed_sigma_mps = root(p[kVx * kStates + kVx]);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j) e.covariance[i * 5 + j] = p[i * kStates + j];
  return e;
}

// How x, y, yaw, velocity x and y of the car depend on the errors.
Eigen::Matrix<double, 5, kErrors> outputs(const Matrix3d& r, const Vector3d& v) {
  Eigen::Matrix<double, 5, kErrors> j = Eigen::Matrix<double, 5, kErrors>::Zero();
  const Vector3d ahead = r.col(0);
  const double level2 = square(ahead.x()) + square(ahead.y());
  j(0, kDp) = j(1, kDp + 1) = 1.0;
  j.block<1, 3>(2, kPhi) << -ahead.x() * ahead.z() / level2, -ahead.y() * ahead.z() / level2, 1.0;
  j.block<2, 3>(3, kDv) = r.transpose().topRows<2>();
  j.block<2, 3>(3, kPhi) = (r.transpose() * cross(v)).topRows<2>();
  return j;
}

void set_sigmas(const SpatialBelief& b, const Matrix3d& r, Estimate& e) {
  const Eigen::Map<const ErrorMatrix> p(b.covariance.data());
  e.position_sigma_m = larger_axis(p(0, 0), p(1, 1), p(0, 1));
  e.height_sigma_m = root(p(2, 2));
  const auto j = outputs(r, as_vector(b.velocity_mps));
  const Eigen::Matrix<double, 5, 5, Eigen::RowMajor> c = j * p * j.transpose();
  e.yaw_sigma_rad = root(c(2, 2));
  e.speed_sigma_mps = root(c(3, 3));
  std::copy(c.data(), c.data() + c.size(), e.covariance.begin());
  const Matrix3d tilt = r.transpose() * p.block<3, 3>(kPhi, kPhi) * r;
  e.roll_sigma_rad = root(tilt(0, 0));
  e.pitch_sigma_rad = root(tilt(1, 1));
}

Estimate estimate_of(const SpatialBelief& b) {
  const Matrix3d r = quaternion_of(b).toRotationMatrix();
  const Angles angles = angles_of(r);
  Estimate e;
  e.at = b.at;
  e.position_m = b.position_m;
  e.yaw_rad = angles.yaw_rad, e.pitch_rad = angles.pitch_rad, e.roll_rad = angles.roll_rad;
  e.velocity_mps = array(r.transpose() * as_vector(b.velocity_mps));
  e.rate_rad_per_s = array(rate_of(b, b.now));
  e.force_mps2 = array(force_of(b, b.now));
  e.gyro_bias_rad_per_s = b.gyro_bias_rad_per_s;
  e.accel_bias_mps2 = b.accel_bias_mps2;
  set_sigmas(b, r, e);
  return e;
}

}  // namespace

void start(FilterState& state, const FilterParams& params, const Seed& seed) {
  state.kind = params.kind;
  state.published = {};
  if (state.kind == FilterKind::kPlanar)
    begin(state.entries, state.planar, planar_from(seed), seed.at);
  else
    begin(state.entries, state.spatial, spatial_from(seed, params.spatial), seed.at);
}

std::optional<Innovation> insert(FilterState& state, const FilterParams& params,
                                 const Measurement& measurement) {
  const Duration window = from_seconds(params.window_s);
  if (state.kind == FilterKind::kPlanar) {
    return insert_into<PlanarModel>(state.entries, state.planar, params.planar, window,
                                    measurement);
  }
  return insert_into<SpatialModel>(state.entries, state.spatial, params.spatial, window,
                                   measurement);
}

Instant newest(const FilterState& state) {
  CHECK(state.entries.size > 0);
  return state.entries[state.entries.size - 1].at;
}

Estimate estimate_at(FilterState& state, const FilterParams& params, Instant now) {
  CHECK(state.entries.size > 0);
  if (state.kind == FilterKind::kPlanar) {
    settle<PlanarModel>(state.entries, state.planar, params.planar);
    PlanarBelief b = state.planar.tip;
    if (now > b.belief.at) advance(b.belief, params.planar.noise, now);
    return estimate_of(b);
  }
  settle<SpatialModel>(state.entries, state.spatial, params.spatial);
  SpatialBelief b = state.spatial.tip;
  advance(b, params.spatial, now, nullptr);
  return estimate_of(b);
}

Estimate publish(FilterState& state, const FilterParams& params, Instant now) {
  Estimate e = estimate_at(state, params, now);
  if (state.kind == FilterKind::kPlanar) return e;
  const Vector3d believed = as_vector(e.position_m);
  const Vector3d velocity =
      rotation_of({e.yaw_rad, e.pitch_rad, e.roll_rad}) * as_vector(e.velocity_mps);
  Vector3d output = believed;
  Published& last = state.published;
  if (last.ever && now > last.at) {
    const double since_s = (now - last.at).seconds();
    const Vector3d expected =
        as_vector(last.position_m) + 0.5 * since_s * (as_vector(last.velocity_mps) + velocity);
    const Vector3d jump = believed - expected;
    const double most_m = params.reentry_mps * since_s;
    if (jump.norm() > most_m) output = expected + (most_m / jump.norm()) * jump;
  }
  last = {.ever = true, .at = now, .position_m = array(output), .velocity_mps = array(velocity)};
  e.correction_left_m = (believed - output).norm();
  e.position_sigma_m = std::hypot(e.position_sigma_m, e.correction_left_m);
  e.position_m = array(output);
  return e;
}

}  // namespace pitwall::localization
