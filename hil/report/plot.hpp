// One plot as SVG: axes, lines, dots, bars, bands, marks. It has a fixed size in pixels, so that
// text keeps its size.
//   in     values in the units of the axes; values outside an axis are drawn at its edge
//   out    svg(): an element without external references. Every element that shows data has the
//          class "mark"; data-* attributes give the scale from pixels to values, for the read-out
//   invariants
//          the same calls give the same bytes
//   errors none; NaN makes a gap
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hil/report/series.hpp"

namespace pitwall::report {

struct Colour {
  std::string_view css;
};
// Palette of Okabe and Ito, which people with colour blindness can distinguish.
inline constexpr Colour kBlue{"#0072b2"}, kVermillion{"#c74d00"}, kGreen{"#00795a"},
    kPurple{"#9c4f80"}, kOrange{"#b97400"}, kSky{"#56b4e9"}, kInk{"#1b232b"}, kGrey{"#66727e"},
    kPale{"#d5dbe1"};

struct Axis {
  double from = 0.0, to = 1.0;  // to < from: the axis runs the other way
  std::string label;
};

// Axis from the smallest to the largest of all values, with a margin; its span is `least_span` if
// they are equal.
Axis axis_over(std::span<const Line> lines, std::string label, double least_span);
// About `count` ticks, in steps of 1, 2 or 5 times a power of ten.
std::vector<double> ticks_of(double from, double to, int count);

struct Bar {
  double from = 0.0, to = 0.0, value = 0.0;
};

struct Size {
  double width = 0.0, height = 0.0;
};

class Plot {
 public:
  enum class Kind { kTime, kPlane, kBars };

  // `name`: identifier for programs, one word; `title`: for readers.
  Plot(std::string name, std::string title, Kind kind, Size size, Axis x, Axis y);

  struct Mark {
    Colour colour = kBlue;
    std::string name, unit;  // for the legend and the read-out; without a name it is in neither
    double width = 1.5;
    bool dashed = false;
  };
  void line(std::span<const Point> points, const Mark& mark);
  void dots(std::span<const Point> points, const Mark& mark, double size);
  void bars(std::span<const Bar> bars, const Mark& mark);
  // Drawn behind the lines, over the whole height.
  void band(double from_x, double to_x, Colour colour, const std::string& label);
  void level(double y, Colour colour, const std::string& label);
  void circle(double radius_x, Colour colour);
  void sign(double x, double y, std::string_view symbol, Colour colour, const std::string& label);
  void x_names(std::vector<std::string> names);  // replace the numbers, at 0.5, 1.5, ...
  struct Name {
    double at = 0.0;
    std::string text;
  };
  // Replace the numbers and the label; names outside the axis are left out.
  void y_names(std::vector<Name> names);

  std::string svg() const;

 private:
  double px(double x) const;
  double py(double y) const;
  std::string path_of(std::span<const Point> points) const;
  std::string opening(std::string_view shape, const Mark& mark) const;
  std::string axes() const;
  std::string x_axis() const;
  std::string y_axis() const;
  std::string y_tick(double y, const std::string& text) const;
  std::string legend() const;

  std::string name_, title_;
  Kind kind_;
  Size size_;
  double left_;
  Axis x_, y_;
  std::vector<std::string> x_names_;
  std::vector<Name> y_names_;
  std::vector<Mark> legend_;
  std::string behind_, marks_;
};

// Row of a chart of states over time: when each state held, on the time axis of the other plots.
struct Lane {
  std::string name;
  struct Piece {
    double from_s = 0.0, to_s = 0.0;
    std::string label;
    Colour fill = kPale;
  };
  std::vector<Piece> pieces;
  std::string absent;  // the reason, if there are no pieces
};
std::string lanes_svg(const std::string& name, const std::string& title,
                      std::span<const Lane> lanes, double width, double end_s);

// Histogram without axes, for a table cell.
std::string small_histogram(std::span<const std::uint64_t> counts, double width, double height,
                            double mark_share);

}  // namespace pitwall::report
