// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/ekf_3d_update.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/autonomy/localization/filter/ekf_3d_model.hpp"

namespace pitwall::localization {
namespace {

using Eigen::Vector3d;

constexpr double kNewSigma = 1.5;          // a sigma that changes more has another kind of error
constexpr std::uint32_t kStreakLeast = 4;  // refusals that make a streak
constexpr double kModelEvery_s = 0.04;     // more often a model says nothing new

// `stretch` of the variance counts in the gain; the gate judges the one value by itself.
template <int N>
Innovation correct(SpatialBelief& b, const Observation& o, double gate_nis, double stretch) {
  using VectorN = Eigen::Matrix<double, N, 1>;
  using MatrixN = Eigen::Matrix<double, N, N>;
  using Tall = Eigen::Matrix<double, kErrors, N>;
  ErrorMatrixMap p(b.covariance.data());
  const VectorN residual = o.residual.head<N>(), variance = stretch * o.variance.head<N>();
  const Eigen::Matrix<double, N, kErrors> h = o.jacobian.topRows<N>();
  const Tall ph = p * h.transpose();
  MatrixN s = h * ph;
  s.diagonal() += o.variance.head<N>();
  Innovation out;
  out.size = N;
  out.nis = residual.dot(s.inverse() * residual);  // closed form up to 3 rows
  if (!(out.nis <= gate_nis)) return out;          // NaN is refused
  s.diagonal() += variance - o.variance.head<N>();
  const MatrixN s_inverse = s.inverse();
  const Tall k = ph * s_inverse;
  // Joseph: (I - K H) P (I - K H)^T + K V K^T, multiplied out by ranks.
  p.noalias() -= k * ph.transpose();
  const Tall rest = k * variance.asDiagonal() - p * h.transpose();
  p.noalias() += rest * k.transpose();
  make_symmetric(b);
  inject(b, k * residual);
  out.accepted = true;
  return out;
}

Innovation correct(SpatialBelief& b, const SpatialParams& p, const Observation& o,
                   double stretch = 1.0) {
  CHECK(o.size >= 1 && o.size <= 3);
  const double gate = p.gate_nis[static_cast<std::size_t>(o.size - 1)];
  if (o.size == 1) return correct<1>(b, o, gate, stretch);
  return o.size == 2 ? correct<2>(b, o, gate, stretch) : correct<3>(b, o, gate, stretch);
}

// Refused for so long, the measurements are right: the belief is opened by what it was wrong.
Innovation correct_or_open(SpatialBelief& b, const SpatialParams& p, const Observation& o,
                           StreakOf kind, double stretch = 1.0) {
  const Innovation innovation = correct(b, p, o, stretch);
  Streak& streak = b.streaks[static_cast<std::size_t>(kind)];
  if (innovation.accepted) {
    streak.count = 0;
    return innovation;
  }
  if (!std::isfinite(innovation.nis)) return innovation;
  if (streak.count == 0) streak.since = b.at;
  ++streak.count;
  if (streak.count < kStreakLeast || (b.at - streak.since).seconds() < p.reacquire_s)
    return innovation;
  const double horizontal = o.size == 1 ? 0.0 : o.residual.head<2>().norm();
  const double vertical = o.size == 3 ? std::abs(o.residual.z()) : 0.0;
  if (kind == StreakOf::kHeading)
    widen(b, kPhi, {0.0, 0.0, o.residual[0]});
  else
    widen(b, kind == StreakOf::kPosition ? kDp : kDv, {horizontal, horizontal, vertical});
  streak.count = 0;
  return correct(b, p, o);
}

// A model's error lasts: in a stream of its values each counts for the share of two correlation
// times that it stands for.
double stretch_of(const SpatialBelief& b, ModelOf model, double correlation_s) {
  const Instant last = b.model_at[static_cast<std::size_t>(model)];
  const double since_s = std::max((b.at - last).seconds(), kModelEvery_s);
  return std::max(1.0, 2.0 * correlation_s / since_s);
}

Innovation correct_by_model(SpatialBelief& b, const SpatialParams& p, const Observation& o,
                            ModelOf model) {
  const Innovation innovation = correct(b, p, o, stretch_of(b, model, p.model_correlation_s));
  b.model_at[static_cast<std::size_t>(model)] = b.at;
  return innovation;
}

Innovation correct_by_heading(SpatialBelief& b, const SpatialParams& p, const Measurement& m) {
  const ModelOf model = m.unit == 0 ? ModelOf::kHeading0 : ModelOf::kHeading1;
  const Innovation innovation = correct_or_open(b, p, baseline_heading(b, p, m), StreakOf::kHeading,
                                                stretch_of(b, model, p.heading_correlation_s));
  if (innovation.accepted) b.model_at[static_cast<std::size_t>(model)] = b.at;
  return innovation;
}

// The model of a kind that comes more often than it has to say something.
std::optional<ModelOf> model_of(Kind kind) {
  if (kind == Kind::kWheelSpeed) return ModelOf::kWheels;
  if (kind == Kind::kSlip) return ModelOf::kSlip;
  if (kind == Kind::kRoad) return ModelOf::kTilt;
  if (kind == Kind::kAttitude) return ModelOf::kAttitude;
  return std::nullopt;
}

bool is_redundant(const SpatialBelief& b, const Measurement& m) {
  const auto model = model_of(m.kind);
  return model && (m.at - b.model_at[static_cast<std::size_t>(*model)]).seconds() < kModelEvery_s;
}

Innovation stand_on_road(SpatialBelief& b, const SpatialParams& p, const Road& road) {
  const Innovation tilt = correct_by_model(b, p, road_tilt(b, p, road), ModelOf::kTilt);
  const Innovation height = correct_by_model(b, p, road_height(b, p, road), ModelOf::kHeight);
  const Innovation normal = correct_by_model(b, p, road_normal(b, p, road), ModelOf::kNormal);
  return {.accepted = tilt.accepted && height.accepted && normal.accepted,
          .nis = tilt.nis + height.nis + normal.nis,
          .size = tilt.size + height.size + normal.size};
}

// A receiver that goes from fixed to float, or back, has another error than before.
void apply_sigma(SpatialBelief& b, const Measurement& m) {
  const double sigma_m = std::max(m.sigma_a, m.sigma_b);
  double& known_m = b.unit_sigma_m[m.unit];
  const bool same = !(sigma_m > kNewSigma * known_m) && !(known_m > kNewSigma * sigma_m);
  known_m = sigma_m;
  if (same) return;
  const int at = kDw + 3 * m.unit;
  ErrorMatrixMap p(b.covariance.data());
  p.middleRows<3>(at).setZero();
  p.middleCols<3>(at).setZero();
  p.diagonal().segment<3>(at).setOnes();
  b.wander[m.unit] = {};
}

}  // namespace

Innovation SpatialModel::fold(SpatialBelief& b, const SpatialParams& p, const Measurement& m,
                              const Measurement* next_imu) {
  if (is_redundant(b, m)) return {.accepted = true, .nis = kUnset, .size = 0};
  advance(b, p, m.at, next_imu);
  switch (m.kind) {
    case Kind::kImu:
      apply_imu(b, p, m);
      return {.accepted = true, .nis = 0.0, .size = 0};
    case Kind::kWiden:
      widen(b, kDp, {m.sigma_a, m.sigma_b, 0.0});
      return {.accepted = true, .nis = 0.0, .size = 0};
    case Kind::kPosition:
      apply_sigma(b, m);
      return correct_or_open(b, p, antenna_position(b, p, m), StreakOf::kPosition);
    case Kind::kVelocity:
      return correct_or_open(b, p, antenna_velocity(b, p, m), StreakOf::kVelocity);
    case Kind::kHeading:
      return correct_by_heading(b, p, m);
    case Kind::kWheelSpeed:
      return correct_by_model(b, p, wheel_speed(b, p, m), ModelOf::kWheels);
    case Kind::kSlip:
      return correct_by_model(b, p, rear_slip(b, p), ModelOf::kSlip);
    case Kind::kRoad:
      return stand_on_road(b, p, m.road);
    case Kind::kAttitude:
      return correct_by_model(b, p, receiver_attitude(b, p, m), ModelOf::kAttitude);
    case Kind::kNone:
      break;
  }
  return {};
}

}  // namespace pitwall::localization
