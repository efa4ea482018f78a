// Watch over the calibration of cameras: where a camera sees cars, against where the LiDARs do.
//   in     admitted frames of detections, in the order of their arrival
//   out    by camera: mean difference of the bearing, mean ratio of the distance; unset before
//          kLeast cars were compared
//   law    a camera's frame is compared with the LiDAR's two frames about it, each of their cars
//          moved on a straight line to the camera's time: tracks have no part, the camera itself
//          pulls them. A car counts where it is the only one near the box, and the box the only one
//          near it. Older comparisons fade: the mean is over the last kMemory
//   use    a report: the operator decides whether the camera is excluded
//   errors none
//   cost   O(boxes * cars) a camera's frame; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/tracking/admission.hpp"
#include "vehicle/world/detection.hpp"

namespace pitwall::tracking {

class CameraWatch {
 public:
  static constexpr std::size_t kLeast = 30, kMemory = 100;
  static constexpr double kNear_rad = 0.1;   // a box is of a car within this
  static constexpr double kNearRatio = 0.5;  // and within this of its distance (logarithm)
  static constexpr double kFrom_m = 8.0, kTo_m = 80.0;
  static constexpr Duration kApartMost = milliseconds(150);  // LiDAR frames that are compared with
  static constexpr double kStep_m = 2.5;  // a car's move between two of them, beside our own motion

  void note(const AdmittedFrame& frame);
  world::CameraBias bias(std::size_t unit) const;

 private:
  struct Place {
    double x_m = kUnset, y_m = kUnset;  // Map
  };
  struct LidarFrame {
    Instant at{};
    OwnMotion own{};
    FixedVector<Place, kMeasurementsMax> cars{};
  };
  struct Mean {
    double bearing_rad = 0.0, log_ratio = 0.0;
    std::uint64_t cars = 0;
  };

  void note_lidar(const AdmittedFrame& frame);
  void compare(const AdmittedFrame& camera, const LidarFrame& before, const LidarFrame& after);

  LidarFrame newest_{};
  bool has_lidar_ = false;
  FixedVector<AdmittedFrame, 4> waiting_{};  // of cameras, for the LiDAR's next frame
  std::array<Mean, world::kWatchedCameras> means_{};
};
static_assert(std::is_trivially_copyable_v<CameraWatch>);

}  // namespace pitwall::tracking
