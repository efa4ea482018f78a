// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/pillars/pillar_detector.hpp"

#include <algorithm>

namespace pitwall::perception {
namespace {

constexpr float kNoCar = -100.0F;  // logit

}  // namespace

Result<std::optional<PillarDetector>, Problem> PillarDetector::read(const std::string& onnx_file,
                                                                    const ReadFile& read_file) {
  if (onnx_file.empty()) return std::optional<PillarDetector>{};
  const auto onnx = read_file(onnx_file);
  if (!onnx) return Unexpected{onnx.error()};
  auto whole = PillarTrunk::load(*onnx, onnx_file);
  if (!whole) return Unexpected{whole.error()};
  auto window = PillarTrunk::load(*onnx, onnx_file, PillarWindow::kRows);
  if (!window) return Unexpected{window.error()};
  return std::optional{PillarDetector{*std::move(whole), *std::move(window)}};
}

std::vector<CarBox> PillarDetector::detect(std::span<const LidarPoint> cloud,
                                           const TrackGround& ground, double others_mps) {
  const std::vector<Pillar> pillars = pillars_of(cloud, ground, others_mps);
  std::vector<CarBox> cars;
  for (const RoadBox& box : boxes_in(pillars, kConfidenceLeast))
    cars.push_back(in_body(box, ground));
  return cars;
}

std::vector<RoadBox> PillarDetector::boxes_in(std::span<const Pillar> pillars,
                                              double confidence_least) {
  const std::vector<PillarWindow> windows = windows_of(pillars);
  if (windows.size() <= kWindowsMost) return decode(look_in(windows, pillars), confidence_least);
  std::vector<float> planes = planes_of(pillars);
  return decode(whole_.run(planes), confidence_least);
}

// As the whole grid's output; where it did not look there is no car.
std::vector<float> PillarDetector::look_in(std::span<const PillarWindow> windows,
                                           std::span<const Pillar> pillars) {
  constexpr std::size_t kColumns = PillarTrunk::kOutColumns;
  constexpr std::size_t kWindowCells = PillarWindow::kRows / PillarTrunk::kStride * kColumns;
  std::vector<float> all(kPillarOutputs * PillarTrunk::kOutCells, kNoCar);
  for (const PillarWindow& window : windows) {
    std::vector<float> planes = planes_of(pillars, window.first_row, PillarWindow::kRows);
    const std::vector<float> seen = window_.run(planes);
    const std::size_t from = (window.core_row - window.first_row) / PillarTrunk::kStride * kColumns;
    const std::size_t to = window.core_row / PillarTrunk::kStride * kColumns;
    constexpr std::size_t kCells = PillarWindow::kCore / PillarTrunk::kStride * kColumns;
    for (std::size_t output = 0; output < kPillarOutputs; ++output)
      std::copy_n(seen.begin() + static_cast<std::ptrdiff_t>(output * kWindowCells + from), kCells,
                  all.begin() + static_cast<std::ptrdiff_t>(output * PillarTrunk::kOutCells + to));
  }
  return all;
}

}  // namespace pitwall::perception
