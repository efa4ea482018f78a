// Everything by which the car sees others: sensors over ROS 2 topics, and its own look at clouds
// and images of them.
//   in     a sensor file; what the car knows of itself, from the 100 Hz loop
//   out    frames of detections in the order in which they came; figures of the sensors
//   law    each sensor has threads of its own (sensor_ingress.hpp, lidar_worker.hpp,
//          camera_worker.hpp): the loop waits for none
//   errors open(): Problem of the file, a network or DDS. Later: counters
//   cost   take(), report(): no allocation, of the loop's thread alone
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vehicle/io/ingress/sensor_ingress.hpp"
#include "vehicle/io/perception/camera_worker.hpp"
#include "vehicle/io/perception/debug_topics.hpp"
#include "vehicle/io/perception/lidar_worker.hpp"

namespace pitwall::io {

class CarSensors {
 public:
  struct Options {
    std::string file;             // empty: no such sensors
    std::optional<int> domain{};  // instead of the file's
    bool debug = false;           // what the car sees, over topics
  };

  // Null without a file. `track` outlives it.
  static Result<std::unique_ptr<CarSensors>, Problem> open(const Options& options,
                                                           const world::TrackMap& track,
                                                           const perception::ReadFile& read_file);

  // All frames since the last call; valid until the next one.
  std::span<const world::DetectionFrame> take();
  void report(const world::EgoState& ego);

  // As SensorIngress::figures(); drops of a camera: images that made no frame as well.
  std::optional<SensorFigures> figures(SensorType type, std::size_t unit, Instant now) const;
  // Of frames of LiDARs, whoever makes them.
  std::optional<SensorFigures> lidar_frames(Instant now) const;
  std::string json(Instant now) const;

 private:
  CarSensors() = default;
  template <class Worker>
  void take_from(Worker& worker);

  std::unique_ptr<SensorIngress> ingress_;
  std::unique_ptr<DebugTopics> debug_;     // null: nobody looks on
  std::unique_ptr<LidarWorker> lidars_;    // null: no LiDAR is looked at here
  std::unique_ptr<CameraWorker> cameras_;  // null: no camera is
  std::vector<world::DetectionFrame> frames_;
};

}  // namespace pitwall::io
