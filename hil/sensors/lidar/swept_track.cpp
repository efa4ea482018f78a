// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/swept_track.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hil/sensors/lidar/body_motion.hpp"
#include "hil/sensors/lidar/track_mesh.hpp"

namespace pitwall::sensors {
namespace {

constexpr double kCarRadius_m = 3.0, kCarHeight_m = 1.5;  // about a body, generously

std::vector<Vector3> rays_of(const LidarPattern& pattern) {
  std::vector<Vector3> rays;
  for (int ring = 0; ring < pattern.rings; ++ring)
    for (int column = 0; column < columns_of(pattern); ++column)
      rays.push_back(ray_of(pattern, ring, column));
  return rays;
}

// The vector of Map, in the frame.
Vector3 within(const Rotation& axes, const Vector3& v) {
  return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)};
}

// Columns whose rays may meet a car, of one ring.
struct Columns {
  int from = 0, until = 0;
};

Columns columns_to(const Vector3& car, const LidarPattern& pattern, double up_rad) {
  const double away_m = std::hypot(car[0], car[1]);
  const int all = columns_of(pattern);
  if (away_m < 2.0 * kCarRadius_m) return {0, all};
  const double least_m = away_m - kCarRadius_m, height_m = least_m * std::tan(up_rad);
  const double most_m = (away_m + kCarRadius_m) * std::tan(up_rad);
  if (std::max(height_m, most_m) < car[2] - kCarHeight_m ||
      std::min(height_m, most_m) > car[2] + kCarHeight_m)
    return {};
  const double half_rad = std::asin(kCarRadius_m / away_m);
  const double first =
      (std::atan2(car[1], car[0]) - half_rad + pattern.half_width_rad) / pattern.ray_step_rad;
  const double last = first + 2.0 * half_rad / pattern.ray_step_rad;
  return {std::clamp(static_cast<int>(std::floor(first)), 0, all),
          std::clamp(static_cast<int>(std::ceil(last)) + 1, 0, all)};
}

// What a sensor in this place sees of the points that one in another place saw.
class Carried {
 public:
  Carried(const SensorFrame& from, const SensorFrame& to)
      : at_(within(to.axes, plus(from.at_m, times(-1.0, to.at_m)))),
        axes_{within(to.axes, from.axes[0]), within(to.axes, from.axes[1]),
              within(to.axes, from.axes[2])} {}
  Vector3 operator()(const Vector3& point) const { return plus(at_, turned(axes_, point)); }

 private:
  Vector3 at_;
  Rotation axes_;
};

// What the rays of a ring meet of cars.
class CarsInRing {
 public:
  CarsInRing(const LidarUnit& unit, const RayScene& body)
      : unit_(unit), body_(body), met_(static_cast<std::size_t>(columns_of(unit.pattern))) {}

  void look(std::span<const Vector3> rays, int ring, const SensorFrame& pose,
            std::span<const BodyMotion> others) {
    std::fill(met_.begin() + looked_at_.from, met_.begin() + looked_at_.until, std::nullopt);
    looked_at_ = {};
    const double up_rad = unit_.pattern.top_rad - ring * unit_.pattern.ring_step_rad;
    for (std::size_t number = 0; number < others.size(); ++number) {
      const BodyMotion& car = others[number];
      const Vector3 to = plus(car.at_m, times(-1.0, pose.at_m));
      const Columns columns = columns_to(within(pose.axes, to), unit_.pattern, up_rad);
      if (columns.from == columns.until) continue;
      looked_at_ = looked_at_.from == looked_at_.until
                       ? columns
                       : Columns{std::min(looked_at_.from, columns.from),
                                 std::max(looked_at_.until, columns.until)};
      const Rotation axes = rotation(car.attitude);
      const Vector3 from = within(axes, times(-1.0, to));
      for (int column = columns.from; column < columns.until; ++column) {
        const auto i = static_cast<std::size_t>(column);
        auto met = body_.first(from, within(axes, turned(pose.axes, rays[i])), unit_.errors.most_m);
        if (!met || (met_[i] && met_[i]->range_m <= met->range_m)) continue;
        met->car = number;
        met_[i] = met;
      }
    }
  }
  const std::optional<Meeting>& at(std::size_t column) const { return met_[column]; }

 private:
  const LidarUnit& unit_;
  const RayScene& body_;
  std::vector<std::optional<Meeting>> met_;
  Columns looked_at_;
};

}  // namespace

SweptTrack::SweptTrack(double length_m, std::vector<LidarUnit> units, std::span<const Mesh> body)
    : length_m_(length_m), units_(std::move(units)), body_(body) {
  for (const LidarUnit& unit : units_) rays_.push_back(rays_of(unit.pattern));
}

SweptTrack SweptTrack::make(const world::TrackMap& track, std::vector<LidarUnit> units,
                            std::span<const Mesh> body, const Options& options) {
  SweptTrack swept{track.length_m(), std::move(units), body};
  const auto count = static_cast<std::size_t>(std::ceil(track.length_m() / options.step_m));
  RayScene scene{track_meshes(track)};
  Noise noise{options.seed, 0};
  for (std::size_t place = 0; place < count; ++place) {
    const double s_m = track.length_m() * static_cast<double>(place) / static_cast<double>(count);
    const double n_m = options.offset_m(s_m);
    const world::TrackPoint at = track.offset(s_m, n_m);
    Place& made = swept.places_.emplace_back();
    made.body = motion_on_road(track,
                               {.x_m = at.x_m,
                                .y_m = at.y_m,
                                .yaw_rad = at.yaw_rad,
                                .vx_mps = 0.0,
                                .vy_mps = 0.0,
                                .yaw_rate_rad_per_s = 0.0,
                                .s_m = s_m,
                                .n_m = n_m},
                               options.origin_m);
    for (std::size_t unit = 0; unit < swept.units_.size(); ++unit)
      made.shots.push_back(shot(swept.units_[unit], made.body, swept.rays_[unit], scene, noise));
  }
  return swept;
}

SweptTrack::Shot SweptTrack::shot(const LidarUnit& lidar, const BodyMotion& body,
                                  std::span<const Vector3> rays, const RayScene& scene,
                                  Noise& noise) {
  const SensorFrame pose = frame_of(lidar.mount, body);
  Shot made;
  for (const Vector3& ray : rays) {
    std::optional<LidarReturn> back;
    if (const auto met = scene.first(pose.at_m, turned(pose.axes, ray), lidar.errors.most_m))
      back = received(*met, ray, 0.0, lidar.errors, noise);
    const double range_m = back ? std::hypot(back->x_m, back->y_m, back->z_m) : 0.0;
    const double signal = back ? std::clamp(static_cast<double>(back->intensity), 0.0, 1.0) : 0.0;
    made.ranges.push_back(static_cast<std::uint16_t>(std::lround(range_m / kRange_m)));
    made.signals.push_back(static_cast<std::uint8_t>(std::lround(signal / kSignal)));
  }
  return made;
}

const SweptTrack::Place& SweptTrack::nearest(double s_m) const {
  const auto count = static_cast<double>(places_.size());
  const double turn = s_m / length_m_ - std::floor(s_m / length_m_);
  return places_[static_cast<std::size_t>(std::lround(turn * count)) % places_.size()];
}

std::vector<LidarReturn> SweptTrack::sweep(std::size_t unit, const BodyMotion& ours, double s_m,
                                           std::span<const BodyMotion> others, Noise& noise) const {
  const LidarUnit& lidar = units_[unit];
  const auto columns = static_cast<std::size_t>(columns_of(lidar.pattern));
  const double forward_mps = std::hypot(ours.velocity_mps[0], ours.velocity_mps[1]);
  std::vector<LidarReturn> returns;
  returns.reserve(rays_[unit].size());
  std::vector<BodyMotion> moved(others.begin(), others.end());
  CarsInRing in_ring{lidar, body_};
  for (int ring = 0; ring < lidar.pattern.rings; ++ring) {
    const double time_s = ring * lidar.pattern.ring_period_s;
    const SensorFrame pose = frame_of(lidar.mount, after(ours, time_s));
    const Place& place = nearest(s_m + forward_mps * time_s);
    const Shot& still = place.shots[unit];
    const Carried carried{frame_of(lidar.mount, place.body), pose};
    for (std::size_t car = 0; car < others.size(); ++car) moved[car] = after(others[car], time_s);
    const std::size_t first = static_cast<std::size_t>(ring) * columns;
    in_ring.look(std::span{rays_[unit]}.subspan(first, columns), ring, pose, moved);
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t i = first + column;
      const double range_m = still.ranges[i] * kRange_m;
      const auto& met = in_ring.at(column);
      if (met && (range_m == 0.0 || met->range_m < range_m)) {
        if (const auto back = received(*met, rays_[unit][i], time_s, lidar.errors, noise))
          returns.push_back(*back);
      } else if (range_m > 0.0) {
        const Vector3 at = carried(times(range_m, rays_[unit][i]));
        returns.push_back(
            {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]),
             static_cast<float>(still.signals[i] * kSignal), static_cast<float>(time_s), -1});
      }
    }
  }
  return returns;
}

}  // namespace pitwall::sensors
