// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/line_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "protocol/vocabulary/text.hpp"
#include "vehicle/raceline/profile/lap_road.hpp"
#include "vehicle/raceline/self_crossing.hpp"

namespace pitwall::raceline {
namespace {

constexpr std::size_t kPointsLeast = 16;
constexpr double kSpacingMost_m = 2.0;
constexpr double kStepShare = 0.01;           // of the spacing, that a step may be off
constexpr double kHeadingMost_rad = 2e-3;     // between a point's heading and its neighbours
constexpr double kMismatchMost_per_m = 5e-5;  // a file rounds places to tenths of a micrometre
constexpr double kMismatchShare = 5e-3;       // of the curvature, for the tightest of corners

class Check {
 public:
  Check(const Raceline& line, const Lanes& lanes, const CarLimits& car)
      : line_(line), lanes_(lanes), car_(car), n_(line.points.size()) {}

  Result<LineFigures, Problem> run() {
    figures_.name = line_.name, figures_.length_m = line_.length_m, figures_.points = n_;
    using Step = std::optional<Problem> (Check::*)();
    for (const Step step : {&Check::points, &Check::geometry, &Check::crossing, &Check::places,
                            &Check::steering, &Check::lap}) {
      if (auto problem = (this->*step)()) return Unexpected{*std::move(problem)};
    }
    return figures_;
  }

 private:
  double s_m(std::size_t i) const { return line_.spacing_m() * static_cast<double>(i % n_); }
  const RacelinePoint& at(std::size_t i) const { return line_.points[i % n_]; }

  Problem problem(std::size_t i, const std::string& what) const {
    return {formatted("%s: s = %.1f m", line_.name.c_str(), s_m(i)), what};
  }
  static void note(Extreme& most, double value, double s_m) {
    if (!(value <= most.value)) most = {value, s_m};
  }
  static void note_least(Extreme& least, double value, double s_m) {
    if (!(value >= least.value)) least = {value, s_m};
  }

  std::optional<Problem> points() {
    if (n_ < kPointsLeast)
      return Problem{line_.name, formatted("%zu points, at least %zu expected", n_, kPointsLeast)};
    if (!(line_.length_m > 0.0) || !(line_.spacing_m() <= kSpacingMost_m))
      return Problem{line_.name, formatted("a length of %.1f m for %zu points: steps of at most "
                                           "%.1f m expected",
                                           line_.length_m, n_, kSpacingMost_m)};
    for (std::size_t i = 0; i < n_; ++i)
      for (const double value :
           {at(i).x_m, at(i).y_m, at(i).yaw_rad, at(i).curvature_per_m, at(i).bank_rad})
        if (!std::isfinite(value)) return problem(i, "a value is missing or not a number");
    if (line_.lap.empty()) return std::nullopt;
    if (line_.lap.size() != n_ || !std::isfinite(line_.lap_s))
      return Problem{line_.name, "the time of the lap, or a part of its speeds, is missing"};
    for (std::size_t i = 0; i < n_; ++i)
      for (const double value :
           {line_.lap[i].speed_mps, line_.lap[i].accel_mps2, line_.lap[i].time_s})
        if (!std::isfinite(value)) return problem(i, "a value is missing or not a number");
    return std::nullopt;
  }

  // The chord to the next point, and the turn to the chord after it.
  double chord_yaw(std::size_t i) const {
    return std::atan2(at(i + 1).y_m - at(i).y_m, at(i + 1).x_m - at(i).x_m);
  }

  // Over two steps of an even row the chords turn by the integral of the curvature under a hat
  // function: h (k- + 10 k + k+) / 12, to fourth order (Numerov).
  std::optional<Problem> geometry() {
    const double h_m = line_.spacing_m();
    for (std::size_t i = 0; i < n_; ++i) {
      const RacelinePoint &before = at(i + n_ - 1), &here = at(i), &after = at(i + 1);
      const double step_m = std::hypot(after.x_m - here.x_m, after.y_m - here.y_m);
      if (!(std::abs(step_m - h_m) <= kStepShare * h_m))
        return problem(i, formatted("the next point is %.3f m away, expected %.3f m", step_m, h_m));
      const double first_rad = chord_yaw(i + n_ - 1), turn_rad = wrap_pi(chord_yaw(i) - first_rad);
      const double off_rad = wrap_pi(here.yaw_rad - first_rad - 0.5 * turn_rad);
      if (!(std::abs(off_rad) <= kHeadingMost_rad))
        return problem(i, formatted("the heading is %.4f rad off that of the points, at most %.4f",
                                    off_rad, kHeadingMost_rad));
      const double curvature =
          (before.curvature_per_m + 10.0 * here.curvature_per_m + after.curvature_per_m) / 12.0;
      const double mismatch = std::abs(turn_rad / h_m - curvature);
      note(figures_.mismatch_most, mismatch, s_m(i));
      if (!(mismatch <= kMismatchMost_per_m + kMismatchShare * std::abs(curvature)))
        return problem(i, formatted("the curvature jumps: the points turn with %.5f 1/m, the line "
                                    "says %.5f 1/m",
                                    turn_rad / h_m, curvature));
    }
    return std::nullopt;
  }

  std::optional<Problem> crossing() {
    const auto found = self_crossing_of(line_.points);
    if (!found) return std::nullopt;
    return problem(found->first,
                   formatted("the line crosses itself, at s = %.1f m again", s_m(found->second)));
  }

  // Once around, forward, with the car between the sides of the region.
  std::optional<Problem> places() {
    const world::TrackMap& track = lanes_.track();
    const world::Curvilinear start = track.project(at(0).x_m, at(0).y_m);
    double station_m = start.s_m, around_m = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      const world::Curvilinear place = track.project(at(i).x_m, at(i).y_m, station_m);
      around_m += std::remainder(place.s_m - station_m, track.length_m());
      station_m = place.s_m;
      const Band free = lanes_.band(line_.region, place.s_m).narrowed(0.5 * car_.width_m);
      const double room_m = std::min(free.left_m - place.n_m, place.n_m - free.right_m);
      note_least(figures_.room_least, room_m, s_m(i));
      if (!(room_m >= 0.0))
        return problem(
            i, formatted("leaves the %s: the side of the car is %.2f m beyond it "
                         "(offset %.2f m, allowed %.2f to %.2f m)",
                         words_of(line_.region), -room_m, place.n_m, free.right_m, free.left_m));
    }
    around_m += std::remainder(start.s_m - station_m, track.length_m());
    if (!(std::abs(around_m - track.length_m()) < 1.0))
      return Problem{line_.name,
                     formatted("goes %.1f m along the track, expected one lap of %.1f m", around_m,
                               track.length_m())};
    return std::nullopt;
  }

  std::optional<Problem> steering() {
    const double curvature_max = std::tan(car_.steer_max_rad) / car_.wheelbase_m;
    for (std::size_t i = 0; i < n_; ++i) {
      const RacelinePoint &a = at(i), &b = at(i + 1);
      const double curvature = std::max(std::abs(a.curvature_per_m), std::abs(b.curvature_per_m));
      note(figures_.curvature_most, curvature, s_m(i));
      if (!(curvature <= curvature_max))
        return problem(i, formatted("a curvature of %.5f 1/m, the car's steering reaches %.5f 1/m",
                                    curvature, curvature_max));
      const double speed_mps = car_.corner_speed_mps(a.curvature_per_m, a.bank_rad);
      note_least(figures_.speed_least, speed_mps, s_m(i));
      const double turn_rad = std::atan(car_.wheelbase_m * b.curvature_per_m) -
                              std::atan(car_.wheelbase_m * a.curvature_per_m);
      const double rate = std::abs(turn_rad) * speed_mps / line_.spacing_m();
      note(figures_.steer_rate_most, rate, s_m(i));
      if (!(rate <= car_.steer_rate_max_rad_per_s))
        return problem(i, formatted("the curvature jumps from %.5f to %.5f 1/m: at %.1f m/s the "
                                    "wheels would turn at %.2f rad/s, at most %.2f",
                                    a.curvature_per_m, b.curvature_per_m, speed_mps, rate,
                                    car_.steer_rate_max_rad_per_s));
    }
    return std::nullopt;
  }

  std::optional<Problem> lap() {
    if (car_.envelope == nullptr || line_.lap.empty()) return std::nullopt;
    const auto lap = check_lap(line_, road_of(line_, lanes_), *car_.envelope);
    if (!lap) return lap.error();
    figures_.lap = *lap;
    return std::nullopt;
  }

  const Raceline& line_;
  const Lanes& lanes_;
  const CarLimits& car_;
  std::size_t n_;
  LineFigures figures_;
};

}  // namespace

Result<LineFigures, Problem> check_raceline(const Raceline& line, const Lanes& lanes,
                                            const CarLimits& car) {
  return Check{line, lanes, car}.run();
}

}  // namespace pitwall::raceline
