// SPDX-License-Identifier: Apache-2.0
#include "hil/report/contact_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hil/report/absent.hpp"
#include "hil/report/plot.hpp"
#include "hil/report/text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

constexpr int kShownBefore = 5;
constexpr double kEvery_s = 0.2;
constexpr double kTick_s = 0.01;        // between two rows of the truth
constexpr double kLeastShown_m = 30.0;  // along the road, so that slow cars do not fill the page
constexpr double kAir_m = 4.0;
constexpr Size kSides{84.0, 70.0};  // what a plot needs beside its frame

// Turns Map so that x is the heading of a car and its place the origin.
class Along {
 public:
  explicit Along(const ContactRow::Car& car)
      : car_(car), c_(std::cos(car.yaw_rad)), s_(std::sin(car.yaw_rad)) {}
  Point operator()(double x_m, double y_m) const {
    const double x = x_m - car_.x_m, y = y_m - car_.y_m;
    return {c_ * x + s_ * y, c_ * y - s_ * x};
  }

 private:
  ContactRow::Car car_;
  double c_, s_;
};

void add_outline(Line& line, const ContactRow::Car& car, const Along& along) {
  const double c = std::cos(car.yaw_rad), s = std::sin(car.yaw_rad);
  constexpr std::array<Point, 5> kCorners{
      {{0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}}};
  for (const Point& corner : kCorners) {
    const double u = corner.x * car.length_m, v = corner.y * car.width_m;
    line.push_back(along(car.x_m + c * u - s * v, car.y_m + s * u + c * v));
  }
  line.push_back({line.back().x, kUnset});
}

// Where the car was each kEvery_s before, by the rows of the log that are of it.
template <class S>
Line outlines_before(const std::vector<At<S>>& rows, double contact_s, ContactRow::Car car,
                     const Along& along, auto&& is_of_car) {
  Line line;
  for (int i = kShownBefore; i > 0; --i) {
    const double due_s = contact_s - kEvery_s * i;
    auto row = std::ranges::lower_bound(rows, due_s - 0.5 * kTick_s, {}, &At<S>::t_s);
    while (row != rows.end() && row->t_s < due_s + kTick_s && !is_of_car(row->v)) ++row;
    if (row == rows.end() || row->t_s >= due_s + kTick_s) continue;
    car.x_m = row->v.x_m, car.y_m = row->v.y_m, car.yaw_rad = row->v.yaw_rad;
    add_outline(line, car, along);
  }
  return line;
}

bool is_placed(const ContactRow::Car& car) {
  return std::isfinite(car.x_m + car.y_m + car.yaw_rad + car.length_m + car.width_m);
}

Axis extent_of(std::span<const Line> lines, bool of_x, double least_m, std::string label) {
  double from = kUnset, to = kUnset;
  for (const Line& line : lines)
    for (const Point& point : line) {
      from = std::fmin(from, of_x ? point.x : point.y);
      to = std::fmax(to, of_x ? point.x : point.y);
    }
  const double air_m = std::max(kAir_m, 0.5 * (least_m - (to - from)));
  return {from - air_m, to + air_m, std::move(label)};
}

std::string name_of_other(const ContactRow& c) {
  return c.with_number > 0.0 ? c.with + formatted(" (number %.0f)", c.with_number) : c.with;
}

std::string picture(const RunData& run, const ContactRow& c) {
  const std::string title = "Both cars in the second before, every 0.2 s";
  if (!is_placed(c.own) || !is_placed(c.other))
    return absent("contact", title, "the log does not say where the cars were");
  const Along along(c.own);
  const Line ours =
      outlines_before(run.truth, c.t_s, c.own, along, [](const auto&) { return true; });
  const Line theirs = outlines_before(run.others, c.t_s, c.other, along,
                                      [&](const auto& v) { return v.number == c.with_number; });
  Line our_last, their_last;
  add_outline(our_last, c.own, along);
  add_outline(their_last, c.other, along);
  const std::array lines{ours, our_last, theirs, their_last};
  const Axis x = extent_of(lines, true, kLeastShown_m, "along the heading of this car, m");
  const Axis y = extent_of(lines, false, 0.0, "to the left, m");
  constexpr double kWidth = 1200.0;
  const double pixels_per_m = (kWidth - kSides.width) / (x.to - x.from);
  const Size size{kWidth, kSides.height + pixels_per_m * (y.to - y.from)};
  Plot plot("contact", title, Plot::Kind::kPlane, size, x, y);
  plot.line(ours, {.colour = kBlue, .name = {}, .unit = {}, .width = 1.0});
  plot.line(theirs, {.colour = kVermillion, .name = {}, .unit = {}, .width = 1.0, .dashed = true});
  plot.line(our_last, {.colour = kBlue, .name = "this car", .unit = "m", .width = 3.0});
  plot.line(
      their_last,
      {.colour = kVermillion, .name = name_of_other(c), .unit = "m", .width = 3.0, .dashed = true});
  if (const Point touched = along(c.x_m, c.y_m); std::isfinite(touched.x + touched.y))
    plot.sign(touched.x, touched.y, "!", kInk, "where they touched");
  return plot.svg();
}

}  // namespace

std::string contact_section(const RunData& run) {
  if (!run.contact) return {};
  const ContactRow& c = *run.contact;
  const std::string other = name_of_other(c);
  const std::string cause = c.is_caused && c.is_caused_by_other ? "both cars"
                            : c.is_caused                       ? "this car"
                            : c.is_caused_by_other              ? other
                                                                : "neither";
  std::string out = "<dl class=\"figures\">";
  const auto add = [&out](const char* name, const std::string& value) {
    out += std::string("<div><dt>") + name + "</dt><dd>" + escaped(value) + "</dd></div>";
  };
  add("caused by", cause);
  add("decided by", c.rule);
  add("with", other);
  add("how", c.kind);
  add("when", number(c.t_s, 2) + " s");
  add("station", number(c.s_m, 0) + " m");
  add("speed of this car", number(c.own.speed_mps, 1) + " m/s");
  add("speed of the other", number(c.other.speed_mps, 1) + " m/s");
  add("closing", number(c.closing_mps, 1) + " m/s");
  add("offset of this car, left positive", number(c.own.n_m, 2) + " m");
  add("offset of the other", number(c.other.n_m, 2) + " m");
  return out + "</dl>\n" + picture(run, c);
}

}  // namespace pitwall::report
