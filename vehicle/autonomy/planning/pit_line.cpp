// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/pit_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "vehicle/autonomy/planning/line_speeds.hpp"
#include "vehicle/autonomy/planning/offset.hpp"

namespace pitwall::planning {
namespace {

constexpr double kSpeedMargin_mps = 0.5;  // below the pit lane's limit
constexpr double kWindow_m = 150.0;       // on which the car may change to the pit line
constexpr double kPaceShare = 0.6;  // of the deceleration, for a change of speed that can wait
constexpr double kPastBox_m = 5.0;  // beyond it the car does not come back

// The offset from the reference line, along the track from the pit lane's entry.
struct Course {
  double length_m = kUnset;
  OffsetChange in, out, round;

  Offset at(double ahead_m) const {
    if (ahead_m > length_m) return offset_at(round, ahead_m);
    return ahead_m < 0.5 * length_m ? offset_at(in, ahead_m) : offset_at(out, ahead_m);
  }
};

double offset_of_line(const Line& line, const world::TrackMap& track, double track_s_m) {
  const auto apart_m = [&](const LinePoint& p) {
    return std::abs(std::remainder(p.track_s_m - track_s_m, track.length_m()));
  };
  return std::ranges::min_element(line.points, {}, apart_m)->n_m;
}

Course course_of(const world::TrackMap& track, const Line& own) {
  const world::PitLane& pit = *track.pit();
  const double length_m = track.station_ahead(pit.entry_s_m, pit.exit_s_m);
  const double ramp_m = world::kPitRampShare * length_m;
  const double from_m = offset_of_line(own, track, pit.entry_s_m);
  const double to_m = offset_of_line(own, track, pit.exit_s_m);
  return {.length_m = length_m,
          .in = {.from_s_m = 0.0, .length_m = ramp_m, .from_m = from_m, .to_m = pit.offset_m},
          .out = {.from_s_m = length_m - ramp_m,
                  .length_m = ramp_m,
                  .from_m = pit.offset_m,
                  .to_m = to_m},
          .round = {.from_s_m = length_m,
                    .length_m = track.length_m() - length_m,
                    .from_m = to_m,
                    .to_m = from_m}};
}

// The pit lane's far side is the wall beside it; on its near side is the ground that nobody
// describes, but on the ramps, which cross it.
LinePoint point_of(const world::TrackMap& track, const Course& course, double ahead_m) {
  const world::PitLane& pit = *track.pit();
  const world::TrackPoint p = track.at(pit.entry_s_m + ahead_m);
  LinePoint middle;
  middle.x_m = p.x_m, middle.y_m = p.y_m, middle.yaw_rad = wrap_pi(p.yaw_rad);
  middle.curvature_per_m = p.curvature_per_m;
  const Offset aside = course.at(ahead_m);
  const Beside at = beside(middle, aside);
  double left_m = p.width_left_m, right_m = p.width_right_m;
  if (ahead_m <= course.length_m) {
    left_m = std::max(left_m, pit.offset_m + 0.5 * pit.width_m);
    right_m = std::max(right_m, 0.5 * pit.width_m - pit.offset_m);
    if (aside.n_m == pit.offset_m && pit.offset_m > 0.0) right_m = 0.5 * pit.width_m - aside.n_m;
    if (aside.n_m == pit.offset_m && pit.offset_m < 0.0) left_m = 0.5 * pit.width_m + aside.n_m;
  }
  return {.track_s_m = track.wrap_station(p.s_m),
          .n_m = aside.n_m,
          .x_m = at.x_m,
          .y_m = at.y_m,
          .yaw_rad = wrap_pi(at.yaw_rad),
          .cos_yaw = std::cos(at.yaw_rad),
          .sin_yaw = std::sin(at.yaw_rad),
          .curvature_per_m = at.curvature_per_m,
          .bank_rad = p.bank_rad,
          .room_left_m = left_m - aside.n_m,
          .room_right_m = right_m + aside.n_m};
}

// Length of the course from the entry to each of its points, which are equally far along the track.
std::vector<double> lengths_of(const world::TrackMap& track, const Course& course) {
  const double step_m = track.length_m() / static_cast<double>(track.size());
  std::vector<double> gone_m{0.0};
  LinePoint last = point_of(track, course, 0.0);
  for (std::size_t i = 1; i <= track.size(); ++i) {
    const double ahead_m = i == track.size() ? 0.0 : step_m * static_cast<double>(i);
    const LinePoint next = point_of(track, course, ahead_m);
    const double chord_m = std::hypot(next.x_m - last.x_m, next.y_m - last.y_m);
    const double bend = 0.5 * std::remainder(next.yaw_rad - last.yaw_rad, 2.0 * std::numbers::pi);
    gone_m.push_back(gone_m.back() + chord_m * (1.0 + bend * bend / 6.0));
    last = next;
  }
  return gone_m;
}

double length_until(const world::TrackMap& track, const std::vector<double>& gone_m,
                    double ahead_m) {
  const double index = ahead_m / track.length_m() * static_cast<double>(track.size());
  const auto i = std::min(static_cast<std::size_t>(index), gone_m.size() - 2);
  return std::lerp(gone_m[i], gone_m[i + 1], index - static_cast<double>(i));
}

void place_points(const world::TrackMap& track, const Course& course, double spacing_m,
                  const std::vector<double>& gone_m, Line& line) {
  const double track_step_m = track.length_m() / static_cast<double>(track.size());
  line.length_m = gone_m.back();
  const auto count = static_cast<std::size_t>(std::ceil(line.length_m / spacing_m));
  line.spacing_m = line.length_m / static_cast<double>(count);
  std::size_t i = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const double s_m = line.spacing_m * static_cast<double>(n);
    while (gone_m[i + 1] <= s_m) ++i;
    const double t = (s_m - gone_m[i]) / (gone_m[i + 1] - gone_m[i]);
    LinePoint p = point_of(track, course, (static_cast<double>(i) + t) * track_step_m);
    p.s_m = s_m;
    line.points.push_back(p);
  }
}

double ahead_m(const Line& line, double from_s_m, double to_s_m) {
  return std::remainder(to_s_m - from_s_m, line.length_m);
}

}  // namespace

Result<std::optional<PitLine>, Problem> pit_line(
    const world::TrackMap& track, const LineParams& params, const Line& own,
    const std::optional<envelope::SteeringLimit>& steering) {
  if (!track.pit()) return std::optional<PitLine>{};
  const world::PitLane& lane = *track.pit();
  const Course course = course_of(track, own);
  const std::vector<double> gone_m = lengths_of(track, course);
  PitLine pit;
  place_points(track, course, params.spacing_m, gone_m, pit.line);
  add_speeds(envelope_of(params, track, steering), std::nullopt, pit.line);
  pit.limit_mps = std::max(lane.speed_limit_mps - kSpeedMargin_mps, 0.5 * lane.speed_limit_mps);
  pit.entry_s_m = 0.0;
  pit.exit_s_m = length_until(track, gone_m, course.length_m);
  const double box_m = std::isfinite(lane.box_s_m)
                           ? track.station_ahead(lane.entry_s_m, lane.box_s_m)
                           : 0.5 * course.length_m;
  pit.box_s_m = length_until(track, gone_m, box_m);
  for (std::size_t row = 0; row < world::kTyreRows; ++row) {
    const bool drives = own.points.front().speed_mps[row] > 0.0;
    for (LinePoint& p : pit.line.points) {
      if (p.s_m > pit.exit_s_m) break;
      double& speed_mps = p.speed_mps[row];
      if (drives && !(speed_mps > 0.0))
        return refuse(track.name() + ": pit", "no speed carries the car through it, " +
                                                  std::to_string(p.s_m) + " m after its entry");
      speed_mps = std::min(speed_mps, pit.limit_mps);
    }
  }
  return std::optional{std::move(pit)};
}

bool turns_in(const PitLine& pit, const OnTheWay& car) {
  const double entry_m = ahead_m(pit.line, car.s_m, pit.entry_s_m);
  const double fall_m2ps2 =
      std::max(car.speed_mps * car.speed_mps - pit.limit_mps * pit.limit_mps, 0.0);
  const double least_m = std::max(car.merge_m, 0.5 * fall_m2ps2 / (kPaceShare * car.decel_mps2));
  return entry_m >= least_m && entry_m <= car.merge_m + kWindow_m;
}

bool is_in_lane(const PitLine& pit, double s_m) { return pit.line.wrap(s_m) <= pit.exit_s_m; }

double to_lane_mps(const PitLine& pit, const OnTheWay& car) {
  const double entry_m = std::max(ahead_m(pit.line, car.s_m, pit.entry_s_m), 0.0);
  return std::sqrt(pit.limit_mps * pit.limit_mps + 2.0 * kPaceShare * car.decel_mps2 * entry_m);
}

double to_box_mps(const PitLine& pit, const OnTheWay& car) {
  const double box_m = ahead_m(pit.line, car.s_m, pit.box_s_m);
  if (box_m < -kPastBox_m) return HUGE_VAL;
  return std::sqrt(2.0 * kPaceShare * car.decel_mps2 * std::max(box_m, 0.0));
}

}  // namespace pitwall::planning
