// Map of the track: a closed reference line sampled at equal stations, with banking and the
// distance to the walls, and curvilinear (Frenet) coordinates along it.
//   frames Map (local tangent plane at the datum); station s in [0, length), offset n positive to
//          the left of the direction of travel; curvature positive left; banking positive where the
//          left side is lower
//   cost   at(): O(1). project(): O(1) near a hint, O(points) without. No allocation after build.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

// One row of a track file: values at a station; linear between rows, closed at the end.
struct TrackKnot {
  double s_m = kUnset, curvature_per_m = kUnset, bank_rad = kUnset;
  double width_left_m = kUnset, width_right_m = kUnset;  // reference line to wall
};

struct PitLane {
  double entry_s_m = kUnset, exit_s_m = kUnset;  // stations of its ends
  double offset_m = kUnset;                      // offset n of its centre line
  double width_m = kUnset, speed_limit_mps = kUnset;
  double box_s_m = kUnset;  // station of the car's box; unset: the middle of the lane
};

// Share of the pit lane's length on which a car crosses from the track to its middle, and back:
// what lies between them a track file does not say.
inline constexpr double kPitRampShare = 0.25;

struct TrackDescription {
  std::string name;
  double length_m = kUnset;
  double datum_latitude_deg = kUnset, datum_longitude_deg = kUnset, datum_height_m = kUnset;
  double start_x_m = 0.0, start_y_m = 0.0, start_yaw_rad = 0.0;  // at s = 0, in Map
  std::vector<TrackKnot> knots;
  std::optional<PitLane> pit;
  std::string source;  // file, for messages
};

struct TrackPoint {
  double s_m = kUnset, x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double curvature_per_m = kUnset, bank_rad = kUnset;
  double width_left_m = kUnset, width_right_m = kUnset;
};

// Road surface at a position: ruled by the banking, with a level reference line.
struct RoadPoint {
  double height_m = kUnset;   // above the datum
  double bank_rad = kUnset;   // lateral, positive where the left side is lower
  double climb_rad = kUnset;  // along the direction of travel, positive uphill
};

struct Curvilinear {
  double s_m = kUnset, n_m = kUnset;
};

class TrackMap {
 public:
  // Integrates the curvature table to a closed line. The residual of position and heading is spread
  // over the lap by the smallest change of curvature. Returns a Problem with its place if this
  // change is beyond 2 % of the largest curvature (the table then describes no closed track), for
  // fewer than 4 knots, stations that do not increase, a width that is not positive, crossing
  // walls, banking beyond 45 degrees, and NaN.
  static Result<TrackMap, Problem> build(const TrackDescription& description);

  const std::string& name() const { return name_; }
  double length_m() const { return length_m_; }
  double datum_latitude_deg() const { return datum_latitude_deg_; }
  double datum_longitude_deg() const { return datum_longitude_deg_; }
  double datum_height_m() const { return datum_height_m_; }
  const std::optional<PitLane>& pit() const { return pit_; }

  double wrap_station(double s_m) const;  // to [0, length)
  // Forward distance between the stations, in [0, length).
  double station_ahead(double from_s_m, double to_s_m) const;
  TrackPoint at(double s_m) const;  // interpolated; s is wrapped
  // Nearest point of the reference line. With a hint the search stays within 50 m of it.
  Curvilinear project(double x_m, double y_m, std::optional<double> hint_s_m = std::nullopt) const;
  // Point with offset n at station s.
  TrackPoint offset(double s_m, double n_m) const;
  // Surface z = -n tan(bank(s)), and its slope along the track at offset n.
  RoadPoint road(double s_m, double n_m) const;
  std::size_t size() const { return points_.size(); }
  const TrackPoint& point(std::size_t i) const { return points_[i]; }  // i < size()

 private:
  TrackMap() = default;
  std::string name_;
  double length_m_ = 0.0, spacing_m_ = 0.0;
  double datum_latitude_deg_ = kUnset, datum_longitude_deg_ = kUnset, datum_height_m_ = kUnset;
  std::optional<PitLane> pit_;
  std::vector<TrackPoint> points_;
};

}  // namespace pitwall::world
