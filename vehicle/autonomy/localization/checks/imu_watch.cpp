// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/imu_watch.hpp"

#include <algorithm>
#include <cmath>

#include "vehicle/steering/learned_steering.hpp"

namespace pitwall::localization {
namespace {

constexpr double kMeanLag_s = 0.02;
constexpr double kIntegrateMax_s = 0.1;  // nothing is integrated over more
constexpr double kCourseSpanMin_s = 0.09, kCourseSpanMax_s = 0.35, kCourseAgeMax_s = 0.25;
constexpr double kTogether = 0.5;  // of the limit: hysteresis, and what may be learned
constexpr std::size_t kRateZ = 2, kForceX = 3, kForceY = 4;

using Units = std::array<double, world::kGnssUnits>;

// How far apart in one axis, in limits.
double excess(const CheckParams& params, const ImuWatch& watch, std::size_t axis) {
  const double limit = axis < kForceX ? params.imu_rate_max_rad_per_s : params.imu_force_max_mps2;
  const double difference = watch.units[1].mean[axis] - watch.units[0].mean[axis];
  return std::abs(difference - watch.offset[axis]) / limit;
}

std::size_t worst_axis(const CheckParams& params, const ImuWatch& watch) {
  std::size_t worst = 0;
  for (std::size_t axis = 1; axis < kImuAxes; ++axis)
    if (excess(params, watch, axis) > excess(params, watch, worst)) worst = axis;
  return worst;
}

void learn_offset(const CheckParams& params, ImuWatch& watch, double dt_s) {
  constexpr double kFirst_s = 1.0;
  watch.offset_known_s = std::min(watch.offset_known_s + dt_s, params.imu_offset_memory_s);
  const double share = dt_s / (watch.offset_known_s + kFirst_s);
  for (std::size_t axis = 0; axis < kImuAxes; ++axis) {
    const double difference = watch.units[1].mean[axis] - watch.units[0].mean[axis];
    watch.offset[axis] += share * (difference - watch.offset[axis]);
  }
}

// By how much the turning of each unit misses that of the course, rad/s; of the receiver that spoke
// last.
std::optional<Units> missed_turning(const ImuWatch& watch, double bank_rad, Instant now) {
  const ImuWatch::Courses* newest = nullptr;
  for (const ImuWatch::Courses& c : watch.courses) {
    if (c.size < 2) continue;
    if (!newest || c.kept[c.size - 1].at > newest->kept[newest->size - 1].at) newest = &c;
  }
  if (!newest) return std::nullopt;
  const ImuWatch::Course& last = newest->kept[newest->size - 1];
  if ((now - last.at).seconds() > kCourseAgeMax_s) return std::nullopt;
  for (std::size_t i = newest->size - 1; i-- > 0;) {
    const ImuWatch::Course& first = newest->kept[i];
    const double span_s = (last.at - first.at).seconds();
    if (span_s < kCourseSpanMin_s) continue;
    if (span_s > kCourseSpanMax_s) return std::nullopt;
    const double course_rad = wrap_pi(last.course_rad - first.course_rad) * std::cos(bank_rad);
    Units missed{};
    for (std::size_t u = 0; u < missed.size(); ++u)
      missed[u] = std::abs(last.turned_rad[u] - first.turned_rad[u] - course_rad) / span_s;
    return missed;
  }
  return std::nullopt;
}

std::optional<Units> missed(const ImuWatch& watch, const ImuReference& reference, std::size_t axis,
                            Instant now) {
  const auto from = [&](double expected) {
    return Units{std::abs(watch.units[0].mean[axis] - expected),
                 std::abs(watch.units[1].mean[axis] - expected)};
  };
  if (axis < kForceX && reference.stands) return from(0.0);
  if (axis == kRateZ) return missed_turning(watch, reference.bank_rad, now);
  if (axis == kForceX && std::isfinite(reference.accel_mps2)) return from(reference.accel_mps2);
  // Whose forces across do not fit its turning and its speed.
  if (axis == kForceY && std::isfinite(reference.speed_mps)) {
    const double turning = 0.5 * (watch.units[0].mean[kRateZ] + watch.units[1].mean[kRateZ]);
    return from(steering::lateral_mps2({reference.speed_mps, turning, reference.bank_rad}));
  }
  return std::nullopt;
}

std::optional<std::size_t> contradicted_unit(const CheckParams& params, const ImuWatch& watch,
                                             const ImuReference& reference, Instant now) {
  // Any axis on which the units differ may have a reference: the worst axis first, then the others.
  const std::size_t worst = worst_axis(params, watch);
  for (std::size_t i = 0; i < kImuAxes; ++i) {
    const std::size_t axis = (worst + i) % kImuAxes;
    if (!(excess(params, watch, axis) > 1.0)) continue;
    const auto off = missed(watch, reference, axis, now);
    if (!off) continue;
    if ((*off)[0] > params.worse_factor * (*off)[1]) return 0;
    if ((*off)[1] > params.worse_factor * (*off)[0]) return 1;
  }
  return std::nullopt;
}

}  // namespace

ImuAxes axes_of(const world::ImuSample& s) {
  return {s.rate_rad_per_s[0],      s.rate_rad_per_s[1],      s.rate_rad_per_s[2],
          s.specific_force_mps2[0], s.specific_force_mps2[1], s.specific_force_mps2[2]};
}

void note(ImuWatch& watch, const world::ImuSample& sample) {
  ImuWatch::Unit& unit = watch.units[sample.unit];
  const ImuAxes axes = axes_of(sample);
  const double dt_s = (sample.at - unit.at).seconds();
  const bool follows = unit.received && dt_s > 0.0 && dt_s <= kIntegrateMax_s;
  if (unit.received && dt_s <= 0.0) return;  // a late one has no part in a mean
  const double share = follows ? dt_s / (dt_s + kMeanLag_s) : 1.0;
  for (std::size_t axis = 0; axis < kImuAxes; ++axis)
    if (std::isfinite(axes[axis])) unit.mean[axis] += share * (axes[axis] - unit.mean[axis]);
  if (follows) unit.turned_rad += dt_s * axes[kRateZ];
  unit.received = true;
  unit.at = sample.at;
}

void note_course(ImuWatch& watch, std::size_t receiver, Instant at, double course_rad) {
  ImuWatch::Courses& courses = watch.courses[receiver];
  if (courses.size > 0 && at <= courses.kept[courses.size - 1].at) return;
  if (courses.size == kCoursesKept) {
    std::move(courses.kept.begin() + 1, courses.kept.end(), courses.kept.begin());
    --courses.size;
  }
  ImuWatch::Course& course = courses.kept[courses.size++];
  course.at = at;
  course.course_rad = course_rad;
  // The sample is older than what the units have turned by now.
  for (std::size_t u = 0; u < world::kGnssUnits; ++u) {
    const ImuWatch::Unit& unit = watch.units[u];
    course.turned_rad[u] = unit.turned_rad - unit.mean[kRateZ] * (unit.at - at).seconds();
  }
}

void watch_imu(const CheckParams& params, ImuWatch& watch, const ImuReference& reference,
               Instant now) {
  constexpr double kTick_s = 0.01;
  const auto alive = [&](const ImuWatch::Unit& unit) {
    return unit.received && (now - unit.at).seconds() <= params.imu_gap_max_s;
  };
  if (!alive(watch.units[0]) || !alive(watch.units[1])) {
    watch.apart = watch.together = false;
    return;
  }
  const double most = excess(params, watch, worst_axis(params, watch));
  const bool apart = most > 1.0, together = most < kTogether;
  if (apart && !watch.apart) watch.apart_since = now;
  if (together && !watch.together) watch.together_since = now;
  watch.apart = apart;
  watch.together = together;
  const bool long_apart = apart && now - watch.apart_since >= from_seconds(params.imu_contradict_s);
  if (long_apart && !watch.faulty) watch.faulty = contradicted_unit(params, watch, reference, now);
  const bool long_together =
      together && now - watch.together_since >= from_seconds(params.readmit_after_s);
  if (long_together) watch.faulty.reset();
  if (together && !watch.faulty) learn_offset(params, watch, kTick_s);
}

}  // namespace pitwall::localization
