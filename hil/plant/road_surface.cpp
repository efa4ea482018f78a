// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/road_surface.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::plant {
namespace {

// Slopes of the surface along and across a direction.
struct Slopes {
  double along = 0.0, across = 0.0;
};

Slopes turned(const Slopes& s, double cosine, double sine) {
  return {s.along * cosine + s.across * sine, s.across * cosine - s.along * sine};
}

// How the horizontal position moves along and across the reference line.
Slopes ground_speed(const Motion& m, const Surface& lie, double heading_error_rad) {
  const double sin_climb = std::sin(lie.climb_rad);
  const double ahead_mps =
      m.vx_mps * std::cos(lie.climb_rad) + m.vy_mps * std::sin(lie.bank_rad) * sin_climb;
  const double left_mps = m.vy_mps * std::cos(lie.bank_rad);
  const double cosine = std::cos(heading_error_rad), sine = std::sin(heading_error_rad);
  return {ahead_mps * cosine - left_mps * sine, ahead_mps * sine + left_mps * cosine};
}

Surface lie_of(const Slopes& car, double height_m) {
  Surface lie;
  lie.climb_rad = std::atan(car.along);
  lie.bank_rad = -std::atan(car.across * std::cos(lie.climb_rad));
  lie.height_m = height_m;
  return lie;
}

// `fixed`: how the slopes along and across the car change while its heading stays.
void add_rates(const Slopes& car, const Slopes& fixed, double yaw_rate_rad_per_s, Surface& lie) {
  const double cos_climb = std::cos(lie.climb_rad), sin_climb = std::sin(lie.climb_rad);
  const double cos_bank = std::cos(lie.bank_rad), sin_bank = std::sin(lie.bank_rad);
  const double grade = 1.0 + car.along * car.along;
  // heading' cos cos = r + climb' sin(bank), climb' = (fixed + heading' across) / grade
  const double heading_rate = (yaw_rate_rad_per_s + sin_bank * fixed.along / grade) /
                              (cos_climb * cos_bank - sin_bank * car.across / grade);
  lie.climb_rate_rad_per_s = (fixed.along + heading_rate * car.across) / grade;
  const double across_rate = fixed.across - heading_rate * car.along;
  const double tangent = car.across * cos_climb;
  lie.bank_rate_rad_per_s =
      -(across_rate * cos_climb - car.across * sin_climb * lie.climb_rate_rad_per_s) /
      (1.0 + tangent * tangent);
}

}  // namespace

RoadSurface::RoadSurface(const world::TrackMap& track, double bank_error_rad, double height_m)
    : spacing_m_(track.length_m() / static_cast<double>(track.size())), height_m_(height_m) {
  const auto knots =
      static_cast<std::size_t>(std::max(4.0, std::round(track.length_m() / kKnot_m)));
  knot_m_ = track.length_m() / static_cast<double>(knots);
  tangent_.reserve(knots);
  for (std::size_t i = 0; i < knots; ++i)
    tangent_.push_back(
        std::tan(track.at(static_cast<double>(i) * knot_m_).bank_rad + bank_error_rad));
  curvature_per_m_.reserve(track.size());
  for (std::size_t i = 0; i < track.size(); ++i)
    curvature_per_m_.push_back(track.point(i).curvature_per_m);
}

RoadSurface::Bank RoadSurface::bank(double s_m) const {
  const std::size_t count = tangent_.size();
  const double place = s_m / knot_m_;
  const std::size_t i = std::min(static_cast<std::size_t>(place), count - 1);
  const double u = place - static_cast<double>(i), v = 1.0 - u;
  const double a = tangent_[(i + count - 1) % count], b = tangent_[i],
               c = tangent_[(i + 1) % count], d = tangent_[(i + 2) % count];
  // As differences from b: a straight piece of constant banking comes out to the last bit.
  const double da = a - b, dc = c - b, dd = d - b;
  const double c_weight = (1.0 + 3.0 * u * (1.0 + u * v)) / 6.0;
  return {
      b + v * v * v / 6.0 * da + c_weight * dc + u * u * u / 6.0 * dd,
      (-0.5 * v * v * da + 0.5 * (1.0 + 2.0 * u - 3.0 * u * u) * dc + 0.5 * u * u * dd) / knot_m_,
      (v * da + (1.0 - 3.0 * u) * dc + u * dd) / (knot_m_ * knot_m_)};
}

RoadSurface::Line RoadSurface::line(double s_m) const {
  const std::size_t count = curvature_per_m_.size();
  const double place = s_m / spacing_m_;
  const std::size_t i = std::min(static_cast<std::size_t>(place), count - 1);
  const double here = curvature_per_m_[i], next = curvature_per_m_[(i + 1) % count];
  return {here + (next - here) * (place - static_cast<double>(i)), (next - here) / spacing_m_};
}

Surface RoadSurface::at(const Road& here, const Motion& motion) const {
  if (tangent_.empty()) return {};
  const Bank t = bank(here.s_m);
  const Line k = line(here.s_m);
  const double secant = std::sqrt(1.0 + t.value * t.value);
  const double stretch = std::max(0.1, 1.0 - k.curvature_per_m * here.n_m);
  const double by_station = t.slope * (height_m_ * t.value / secant - here.n_m);
  const double by_station_twice = t.bend * (height_m_ * t.value / secant - here.n_m) +
                                  height_m_ * t.slope * t.slope / (secant * secant * secant);
  const Slopes road{by_station / stretch, -t.value};
  const double cosine = std::cos(here.heading_error_rad), sine = std::sin(here.heading_error_rad);
  const Slopes car = turned(road, cosine, sine);
  Surface lie = lie_of(car, height_m_ * secant - here.n_m * t.value);

  const Slopes speed = ground_speed(motion, lie, here.heading_error_rad);
  const double station_mps = speed.along / stretch;
  const Slopes rate{
      (by_station_twice * station_mps - t.slope * speed.across) / stretch +
          by_station / (stretch * stretch) *
              (k.curvature_per_m * speed.across + here.n_m * k.change_per_m2 * station_mps),
      -t.slope * station_mps};
  // The frame of the line turns under the car.
  const double line_turns = k.curvature_per_m * station_mps;
  const Slopes changing = turned(rate, cosine, sine);
  add_rates(car,
            {changing.along - line_turns * car.across, changing.across + line_turns * car.along},
            motion.yaw_rate_rad_per_s, lie);
  return lie;
}

}  // namespace pitwall::plant
