// Calibration of a camera as ROS' camera_calibration and camera_info_manager write it:
//
//     image_width: 2064
//     image_height: 960
//     camera_name: front_narrow
//     camera_matrix: {rows: 3, cols: 3, data: [2010.5, 0, 1030.2, 0, 2011.0, 478.9, 0, 0, 1]}
//     distortion_model: plumb_bob            # or rational_polynomial
//     distortion_coefficients: {rows: 1, cols: 5, data: [-0.3, 0.1, 0.001, -0.0005, 0]}
//     rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
//     projection_matrix: {rows: 3, cols: 4, data: [1990, 0, 1031, 0, 0, 2000, 479, 0, 0, 0, 1, 0]}
//
//   out    the model of the image as it comes from the camera; of the rectified image, that of the
//          projection matrix, whose axis is that of the rectified camera
//   errors Problem with file, line and column: a matrix of another size or form, a model that is
//          none of the two, a focal length or a centre that no camera with this image has
//   source REP 104, sensor_msgs/CameraInfo
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/autonomy/perception/camera/camera_model.hpp"

namespace pitwall::io {

enum class ImageKind : std::uint8_t { kRaw, kRectified };

Result<perception::CameraModel, Problem> read_calibration(const std::string& path, ImageKind kind);

}  // namespace pitwall::io
