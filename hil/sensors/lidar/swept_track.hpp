// Sweeps of LiDARs over a track, made beforehand: what stands still is shot once, from places along
// the lap, and only the other cars are shot when a sweep is asked for. Fast enough for a live run.
//   in     the true car and the others in Map, at the begin of the sweep
//   out    as lidar_sweep()
//   law    a point of what stands still keeps its place in Map: it was seen from the nearest of the
//          places, at most half a step away along the lap, and has that place's noise, every lap.
//          A car hides what is behind it
//   errors none
//   cost   make(): 30 ms and 0.5 MB a place of three LiDARs. sweep(): 2 ms a LiDAR
//   limit  what the car would see past a wall's edge from its own lane is what the lane of the
//          places sees; no dust
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hil/sensors/lidar/lidar.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::sensors {

class SweptTrack {
 public:
  struct Options {
    double step_m = 5.0;                                                      // at most
    std::function<double(double s_m)> offset_m = [](double) { return 0.0; };  // of the places
    double origin_m = 0.28;  // of Body over the road
    std::uint64_t seed = 1;
  };
  // `body`: of every other car, in Vehicle.
  static SweptTrack make(const world::TrackMap& track, std::vector<LidarUnit> units,
                         std::span<const Mesh> body, const Options& options);

  std::span<const LidarUnit> units() const { return units_; }
  // `s_m` is the station of our car.
  std::vector<LidarReturn> sweep(std::size_t unit, const BodyMotion& ours, double s_m,
                                 std::span<const BodyMotion> others, Noise& noise) const;

 private:
  // What came back of each ray of a sweep at rest; a range of 0: nothing.
  struct Shot {
    std::vector<std::uint16_t> ranges;  // in kRange_m
    std::vector<std::uint8_t> signals;  // in kSignal
  };
  struct Place {
    BodyMotion body;
    std::vector<Shot> shots;  // of each LiDAR
  };
  SweptTrack(double length_m, std::vector<LidarUnit> units, std::span<const Mesh> body);
  static constexpr double kRange_m = 0.004, kSignal = 1.0 / 255.0;
  static Shot shot(const LidarUnit& lidar, const BodyMotion& body, std::span<const Vector3> rays,
                   const RayScene& scene, Noise& noise);
  const Place& nearest(double s_m) const;

  double length_m_;
  std::vector<LidarUnit> units_;
  RayScene body_;                           // of a car that stands at the origin
  std::vector<std::vector<Vector3>> rays_;  // of each LiDAR
  std::vector<Place> places_;               // at equal distances, from station 0
};

}  // namespace pitwall::sensors
