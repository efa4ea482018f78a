// What a camera sees where: pixels to normalized image points and back, by the model that
// calibrations of OpenCV and ROS fill in.
//   in     a pixel of the image as it comes from the camera, u to the right, v down
//   out    undistort(): x to the right and y down, at depth 1 along the optical axis. project() is
//          the way back
//   law    project() of undistort() is the pixel, to 1e-6 px
//   errors undistort(): nullopt where the model has no inverse, beyond the image's useful part
//   cost   without distortion two divisions, with it some five steps; no allocation
//   source OpenCV, "Camera calibration and 3D reconstruction": plumb_bob has k1, k2, p1, p2, k3,
//          the rational model k4 to k6 too. Inverse: Newton's method
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::perception {

struct Pixel {
  double u_px = kUnset, v_px = kUnset;
};

struct NormalizedPoint {
  double x = kUnset, y = kUnset;  // for 1 of depth
};

struct CameraModel {
  static constexpr std::size_t kCoefficients = 8;  // k1, k2, p1, p2, k3, k4, k5, k6

  double focal_x_px = kUnset, focal_y_px = kUnset;
  double centre_x_px = kUnset, centre_y_px = kUnset;
  std::array<double, kCoefficients> distortion{};

  static CameraModel pinhole(double focal_px, double centre_x_px) {
    return {focal_px, focal_px, centre_x_px, 0.0, {}};
  }
};

Pixel project(const CameraModel& camera, const NormalizedPoint& point);
std::optional<NormalizedPoint> undistort(const CameraModel& camera, const Pixel& at);

}  // namespace pitwall::perception
