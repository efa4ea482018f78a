// Measurement models of the method "road": what LiDAR, camera and radar measure of a track, and the
// update of the extended Kalman filter.
//   in     a track, a detection, our own motion at the time of its frame
//   out    the difference between the two with its covariance; the updated track
//   frames kLidar position and yaw in Map; kCamera bearing and inverse depth, kRadar range, bearing
//          and range rate from the centre of gravity of our car
//   invariants
//          the yaw of a box counts up to half a turn: front and back may be exchanged
//   cost   0.5 us for an update; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "vehicle/autonomy/tracking/filter/filter_params.hpp"
#include "vehicle/autonomy/tracking/filter/frame.hpp"
#include "vehicle/autonomy/tracking/filter/motion.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking {

// Position and motion of a track in Map. Row by row: x, y, yaw, speed, by the first four states.
struct Place {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset, speed_mps = kUnset;
  double curvature_per_m = 0.0;  // of the road
  std::array<std::array<double, 4>, 4> jacobian{};
};
Place place_of(const world::TrackMap* map, const StateVector& x);

inline constexpr std::size_t kValuesMax = 3;  // of a detection
using Values = std::array<double, kValuesMax>;

// Values that a sensor should measure of a track, and their Jacobian by the first four states.
struct Expectation {
  Values value{};
  std::array<std::array<double, 4>, kValuesMax> jacobian{};
};
Expectation expectation_of(world::DetectionSource source, const OwnMotion& own, const Place& place);

// Way along the road from one place to another.
double way_m(const world::TrackMap* map, double from_m, double to_m);

// Its covariance (H P H') if the car is in this mode, about the states of the track.
using Spread = std::array<Values, kValuesMax>;
Spread spread_of(const Expectation& expectation, std::size_t mode, const Modes& modes);

// Values of a detection in the order and the frame of an Expectation, or their difference from one;
// the sensor's variances. The first `size` are set.
struct Innovation {
  std::size_t size = 0;
  Values value{}, variance{};
};
Innovation reading_of(const RoadParams& params, const FrameKey& sensor, const OwnMotion& own,
                      const Measurement& m);
// Read minus expected.
Innovation innovation_of(world::DetectionSource source, const Innovation& reading,
                         const Expectation& e);

struct Distance {
  double square = kUnset;  // Mahalanobis
  double log_det = 0.0;    // of the covariance of the innovation
};
// The square is infinite where one value alone is beyond `most`.
Distance distance_of(const Spread& spread, const Innovation& innovation, double most);

// Updates every mode, and by how well each expected it their probability; they are not joined. The
// innovation is that of the expectation.
void update(const Expectation& expectation, const Innovation& innovation,
            const world::TrackMap* map, Track& track);

// Position of a detection in Map; unset for a bearing without a depth.
struct Position {
  double x_m = kUnset, y_m = kUnset;
};
Position position_of(world::DetectionSource source, const OwnMotion& own, const Measurement& m);

// Station and offset of a position, looked for near the station as far ahead of us, or behind, as
// the position is away.
world::Curvilinear station_of(const world::TrackMap& map, const OwnMotion& own, const Position& at);

// Noise of a box in each axis, and of one of the cameras.
double lidar_sigma_m(const RoadParams& params, double distance_m);
struct CameraSigma {
  double bearing_rad, inverse_depth_per_m;
};
// That which the detector gave, else that of the unit.
CameraSigma camera_sigma(const RoadParams& params, std::uint8_t unit, const Measurement& m,
                         double distance_m);

// Standard deviation along and across the line of sight, at a distance.
struct SightSigma {
  double along_m, across_m;
};
SightSigma sight_sigma(const RoadParams& params, const FrameKey& sensor, const Measurement& m,
                       double distance_m);

}  // namespace pitwall::tracking
