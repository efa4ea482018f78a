// Cars in a merged cloud by the pillar network.
//   in     cloud in Body at the reference time; the map's ground under it
//   out    boxes, the surest first
//   errors read(): Problem with the file: it cannot be read, or as PillarTrunk
//   cost   35 ms of one processor; allocates
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/autonomy/perception/lidar/car_box.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_trunk.hpp"
#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"
#include "vehicle/autonomy/perception/lidar/track_ground.hpp"

namespace pitwall::perception {

// Trained on scenes of the bench: training/ beside it.
inline constexpr const char* kPillarNetworkFile = "vehicle/config/networks/lidar_pillars.onnx";

class PillarDetector {
 public:
  // By drawn scenes of the tracks of its training that it had not seen: 0.008 false cars a sweep.
  static constexpr double kConfidenceLeast = 0.55;

  using ReadFile = std::function<Result<std::string, Problem>(const std::string& path)>;

  // None where there is no name of a file.
  static Result<std::optional<PillarDetector>, Problem> read(const std::string& onnx_file,
                                                             const ReadFile& read_file);
  std::vector<CarBox> detect(std::span<const LidarPoint> cloud, const TrackGround& ground,
                             double others_mps);
  std::vector<float> run(std::vector<float>& planes) { return trunk_.run(planes); }

 private:
  explicit PillarDetector(PillarTrunk trunk) : trunk_(std::move(trunk)) {}
  PillarTrunk trunk_;
};

}  // namespace pitwall::perception
