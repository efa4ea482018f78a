// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/pillars/pillar_detector.hpp"

#include "vehicle/autonomy/perception/lidar/pillars/pillar_decoder.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_grid.hpp"

namespace pitwall::perception {

Result<std::optional<PillarDetector>, Problem> PillarDetector::read(const std::string& onnx_file,
                                                                    const ReadFile& read_file) {
  if (onnx_file.empty()) return std::optional<PillarDetector>{};
  const auto onnx = read_file(onnx_file);
  if (!onnx) return Unexpected{onnx.error()};
  auto trunk = PillarTrunk::load(*onnx, onnx_file);
  if (!trunk) return Unexpected{trunk.error()};
  return std::optional{PillarDetector{*std::move(trunk)}};
}

std::vector<CarBox> PillarDetector::detect(std::span<const LidarPoint> cloud,
                                           const TrackGround& ground, double others_mps) {
  std::vector<float> planes = planes_of(pillars_of(cloud, ground, others_mps));
  std::vector<CarBox> cars;
  for (const RoadBox& box : decode(trunk_.run(planes), kConfidenceLeast))
    cars.push_back(in_body(box, ground));
  return cars;
}

}  // namespace pitwall::perception
