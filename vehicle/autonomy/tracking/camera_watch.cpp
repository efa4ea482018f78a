// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/camera_watch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pitwall::tracking {
namespace {

using world::DetectionSource;

double mixed(double a, double b, double share_of_b) { return a + share_of_b * (b - a); }

struct Sighting {
  double bearing_rad, distance_m;  // from our own car
};

Sighting sighting(double x_m, double y_m, const OwnMotion& own) {
  const double dx_m = x_m - own.x_m, dy_m = y_m - own.y_m;
  return {wrap_pi(std::atan2(dy_m, dx_m) - own.yaw_rad), std::hypot(dx_m, dy_m)};
}

bool is_near(const Measurement& box, const Sighting& car) {
  return std::abs(wrap_pi(box.value[0] - car.bearing_rad)) < CameraWatch::kNear_rad;
}

}  // namespace

void CameraWatch::note(const AdmittedFrame& frame) {
  if (frame.key.source == DetectionSource::kLidar) return note_lidar(frame);
  if (frame.key.source != DetectionSource::kCamera || frame.key.unit >= world::kWatchedCameras)
    return;
  // One that finds no room is not compared: nothing hangs on a single frame.
  if (has_lidar_) (void)waiting_.push(frame);
}

void CameraWatch::note_lidar(const AdmittedFrame& frame) {
  if (has_lidar_ && frame.key.at <= newest_.at) return;  // it came late: no new span
  LidarFrame next{.at = frame.key.at, .own = frame.own};
  const double c = std::cos(frame.own.yaw_rad), s = std::sin(frame.own.yaw_rad);
  for (const Measurement& m : frame.measurements)
    (void)next.cars.push({frame.own.x_m + c * m.value[0] - s * m.value[1],
                          frame.own.y_m + s * m.value[0] + c * m.value[1]});
  if (has_lidar_ && next.at - newest_.at <= kApartMost)
    for (const AdmittedFrame& camera : waiting_)
      if (camera.key.at >= newest_.at && camera.key.at <= next.at) compare(camera, newest_, next);
  FixedVector<AdmittedFrame, 4> later;
  for (const AdmittedFrame& camera : waiting_)
    if (camera.key.at > next.at) (void)later.push(camera);
  waiting_ = later;
  newest_ = next, has_lidar_ = true;
}

void CameraWatch::compare(const AdmittedFrame& camera, const LidarFrame& before,
                          const LidarFrame& after) {
  const double share = (camera.key.at - before.at).seconds() / (after.at - before.at).seconds();
  const double span_s = (after.at - before.at).seconds();
  FixedVector<Sighting, kMeasurementsMax> cars;
  for (const Place& from : before.cars) {
    // Cars that race go as we do, to some metres a second.
    const double x_m = from.x_m + span_s * before.own.vx_mps;
    const double y_m = from.y_m + span_s * before.own.vy_mps;
    const auto* const to = std::ranges::min_element(after.cars, {}, [&](const Place& place) {
      return std::hypot(place.x_m - x_m, place.y_m - y_m);
    });
    if (to == after.cars.end() || std::hypot(to->x_m - x_m, to->y_m - y_m) > kStep_m) continue;
    (void)cars.push(
        sighting(mixed(from.x_m, to->x_m, share), mixed(from.y_m, to->y_m, share), camera.own));
  }
  Mean& mean = means_[camera.key.unit];
  for (const Measurement& box : camera.measurements) {
    const auto near = [&](const Sighting& car) { return is_near(box, car); };
    if (std::ranges::count_if(cars, near) != 1) continue;
    const Sighting& car = *std::ranges::find_if(cars, near);
    const auto boxes_near = std::ranges::count_if(
        camera.measurements, [&](const Measurement& other) { return is_near(other, car); });
    const double log_ratio = -std::log(box.value[1] * car.distance_m);  // the camera's over ours
    if (boxes_near != 1 || car.distance_m < kFrom_m || car.distance_m > kTo_m ||
        !(std::abs(log_ratio) < kNearRatio))
      continue;
    mean.cars = std::min<std::uint64_t>(mean.cars + 1, kMemory);
    const double weight = 1.0 / static_cast<double>(mean.cars);
    mean.bearing_rad += weight * (wrap_pi(box.value[0] - car.bearing_rad) - mean.bearing_rad);
    mean.log_ratio += weight * (log_ratio - mean.log_ratio);
  }
}

world::CameraBias CameraWatch::bias(std::size_t unit) const {
  const Mean& mean = means_[unit];
  if (mean.cars < kLeast) return {};
  return {mean.bearing_rad, std::exp(mean.log_ratio)};
}

}  // namespace pitwall::tracking
