// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/camera/camera_model.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::perception {
namespace {

// The distorted direction and how it changes with the direction.
struct Distorted {
  NormalizedPoint point;
  double dx_dx = 1.0, dx_dy = 0.0, dy_dx = 0.0, dy_dy = 1.0;
};

Distorted distorted(const CameraModel& camera, const NormalizedPoint& point) {
  const auto [k1, k2, p1, p2, k3, k4, k5, k6] = camera.distortion;
  const double x = point.x, y = point.y, r2 = x * x + y * y;
  const double above = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double below = 1.0 + r2 * (k4 + r2 * (k5 + r2 * k6));
  const double above_slope = k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3);  // by r2
  const double below_slope = k4 + r2 * (2.0 * k5 + r2 * 3.0 * k6);
  const double radial = above / below;
  const double slope = 2.0 * (above_slope - radial * below_slope) / below;  // by r2, twice
  Distorted out;
  out.point = {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
               y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
  out.dx_dx = radial + x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x;
  out.dx_dy = x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y;
  out.dy_dx = out.dx_dy;
  out.dy_dy = radial + y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
  return out;
}

bool has_distortion(const CameraModel& camera) {
  return std::ranges::any_of(camera.distortion, [](double k) { return k != 0.0; });
}

}  // namespace

Pixel project(const CameraModel& camera, const NormalizedPoint& point) {
  const NormalizedPoint seen = distorted(camera, point).point;
  return {camera.centre_x_px + camera.focal_x_px * seen.x,
          camera.centre_y_px + camera.focal_y_px * seen.y};
}

std::optional<NormalizedPoint> undistort(const CameraModel& camera, const Pixel& at) {
  constexpr int kStepsMost = 30;
  constexpr double kNear = 1e-12;
  const NormalizedPoint seen{(at.u_px - camera.centre_x_px) / camera.focal_x_px,
                             (at.v_px - camera.centre_y_px) / camera.focal_y_px};
  if (!has_distortion(camera)) return seen;
  NormalizedPoint point = seen;
  for (int i = 0; i < kStepsMost; ++i) {
    const Distorted now = distorted(camera, point);
    const double off_x = seen.x - now.point.x, off_y = seen.y - now.point.y;
    if (std::abs(off_x) < kNear && std::abs(off_y) < kNear) return point;
    // Of a lens this is positive from the axis to where its image folds back.
    const double determinant = now.dx_dx * now.dy_dy - now.dx_dy * now.dy_dx;
    if (!(determinant > 0.0)) return std::nullopt;
    point.x += (now.dy_dy * off_x - now.dx_dy * off_y) / determinant;
    point.y += (now.dx_dx * off_y - now.dy_dx * off_x) / determinant;
  }
  return std::nullopt;
}

}  // namespace pitwall::perception
