// What the bench publishes for the sensors of a car: by its sensor file and its scenario.
//   in     the true cars, at every step of the rig
//   out    detections, clouds and images on the topics of the file's rows
//   errors open(): Problem of the file or of DDS; of a scenario that wants what the file lacks.
//          Later: counts
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "hil/bench/live/publishers/cloud_publisher.hpp"
#include "hil/bench/live/publishers/detection_publisher.hpp"
#include "hil/bench/live/publishers/image_publisher.hpp"
#include "hil/scenario/scenario.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::bench {

struct CarFeeds {
  std::optional<DetectionPublisher> detections;  // none: the car has no such sensors
  std::unique_ptr<CloudPublisher> clouds;        // none: its LiDARs shoot no rays
  std::unique_ptr<ImagePublisher> images;        // none: its cameras take no images

  // `sensor_file`: empty where the run names none. `track` outlives it; `offset_m`: of the car's
  // line at a station.
  static Result<CarFeeds, Problem> open(const std::string& sensor_file, int domain,
                                        const scenario::Scenario& run, const world::TrackMap& track,
                                        const std::function<double(double s_m)>& offset_m,
                                        std::span<const faults::BenchFault> faults);

  // `at` is scenario time, `started` the time of this process at its zero; `s_m` our station.
  void show(const plant::Truth& ours, double s_m, const sensors::TrueCars& cars, Instant at,
            Instant started);
  // Adds what was sent and lost.
  void add_to(RunResult& result) const;
};

}  // namespace pitwall::bench
