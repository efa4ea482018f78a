// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/calibration_file.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::io {
namespace {

using perception::CameraModel;

constexpr std::int64_t kPixelsMost = 20'000;
constexpr double kFocalMost = 50.0;  // widths of the image
constexpr double kEntryMost = 1e6;

std::vector<double> matrix(yaml::StrictMap& map, const std::string& key, std::int64_t rows,
                           std::int64_t columns_least, std::int64_t columns_most) {
  yaml::StrictMap of = map.map(key);
  (void)of.integer("rows", rows, rows);
  const std::int64_t columns = of.integer("cols", columns_least, columns_most);
  const auto count = static_cast<std::size_t>(rows * columns);
  return of.numbers("data", count, count, -kEntryMost, kEntryMost);
}

// From the first three columns of a camera or projection matrix.
CameraModel optics(const yaml::StrictMap& map, const std::string& key,
                   const std::vector<double>& entries, double width_px, double height_px) {
  const std::size_t columns = entries.size() / 3;
  const auto at = [&](std::size_t row, std::size_t column) {
    return entries[row * columns + column];
  };
  const bool has_form =
      at(0, 1) == 0.0 && at(1, 0) == 0.0 && at(2, 0) == 0.0 && at(2, 1) == 0.0 && at(2, 2) == 1.0;
  if (!has_form) map.fail(key, "expected [fx, 0, cx], [0, fy, cy], [0, 0, 1] on the left");
  const CameraModel camera{at(0, 0), at(1, 1), at(0, 2), at(1, 2), {}};
  for (const double focal_px : {camera.focal_x_px, camera.focal_y_px})
    if (!(focal_px > 0.0 && focal_px < kFocalMost * width_px))
      map.fail(key, "expected a focal length above 0 and below 50 widths of the image");
  if (!(camera.centre_x_px > 0.0 && camera.centre_x_px < width_px && camera.centre_y_px > 0.0 &&
        camera.centre_y_px < height_px))
    map.fail(key, "expected a centre within the image");
  return camera;
}

CameraModel model_in(yaml::StrictMap& map, ImageKind kind) {
  const auto width_px = static_cast<double>(map.integer("image_width", 1, kPixelsMost));
  const auto height_px = static_cast<double>(map.integer("image_height", 1, kPixelsMost));
  (void)map.text_or("camera_name", {});
  CameraModel raw =
      optics(map, "camera_matrix", matrix(map, "camera_matrix", 3, 3, 3), width_px, height_px);
  const std::string model = map.text("distortion_model");
  const bool is_rational = model == "rational_polynomial";
  if (!is_rational && model != "plumb_bob")
    map.fail("distortion_model", "expected plumb_bob or rational_polynomial");
  const std::int64_t count = is_rational ? 8 : 5;
  std::ranges::copy(matrix(map, "distortion_coefficients", 1, count, count),
                    raw.distortion.begin());
  (void)matrix(map, "rectification_matrix", 3, 3, 3);
  const CameraModel rectified = optics(
      map, "projection_matrix", matrix(map, "projection_matrix", 3, 4, 4), width_px, height_px);
  return kind == ImageKind::kRaw ? raw : rectified;
}

}  // namespace

Result<CameraModel, Problem> read_calibration(const std::string& path, ImageKind kind) {
  const auto document = yaml::load_file(path);
  if (!document) return Unexpected{document.error()};
  return yaml::read(*document, [kind](yaml::StrictMap& map) { return model_in(map, kind); });
}

}  // namespace pitwall::io
