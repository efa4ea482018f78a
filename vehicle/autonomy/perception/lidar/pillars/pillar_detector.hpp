// Cars in a merged cloud by the pillar network.
//   in     cloud in Body at the reference time; the map's ground under it
//   out    boxes, the surest first
//   errors read(): Problem with the file: it cannot be read, or as PillarTrunk
//   law    where nothing stands over the road the network does not look, with the same result
//   cost   10 ms of one processor, and 7 ms for each 25 m of road on which something stands, at
//          most 35 ms. Allocates
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
#include "vehicle/autonomy/perception/lidar/pillars/pillar_decoder.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_trunk.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_windows.hpp"
#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"
#include "vehicle/autonomy/perception/lidar/track_ground.hpp"

namespace pitwall::perception {

// Trained on scenes of the bench: training/ beside it.
inline constexpr const char* kPillarNetworkFile = "vehicle/config/networks/lidar_pillars.onnx";

class PillarDetector {
 public:
  // By drawn scenes of the tracks of its training that it had not seen: 0.008 false cars a sweep.
  static constexpr double kConfidenceLeast = 0.55;

  // None where there is no name of a file.
  static Result<std::optional<PillarDetector>, Problem> read(const std::string& onnx_file,
                                                             const ReadFile& read_file);
  std::vector<CarBox> detect(std::span<const LidarPoint> cloud, const TrackGround& ground,
                             double others_mps);
  std::vector<RoadBox> boxes_in(std::span<const Pillar> pillars, double confidence_least);
  // Of the whole grid.
  std::vector<float> run(std::vector<float>& planes) { return whole_.run(planes); }

 private:
  // More are dearer than the whole grid.
  static constexpr std::size_t kWindowsMost = 3;

  PillarDetector(Network whole, Network window)
      : whole_(std::move(whole)), window_(std::move(window)) {}
  std::vector<float> look_in(std::span<const PillarWindow> windows,
                             std::span<const Pillar> pillars);

  Network whole_, window_;
};

}  // namespace pitwall::perception
