// SPDX-License-Identifier: Apache-2.0
#include "hil/report/plot.hpp"

#include <algorithm>
#include <cmath>

#include "hil/report/text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

// Time plots stand below each other and leave room for the names of lanes.
constexpr double kPlaneLeft = 68.0, kTimeLeft = 124.0, kRight = 16.0, kTop = 30.0, kBottom = 40.0;
constexpr double kLetter = 7.3;  // mean width of a letter of 12 px

std::string text_at(double x, double y, std::string_view anchor, std::string_view style,
                    const std::string& text) {
  return formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%.*s\"", x, y,
                   static_cast<int>(anchor.size()), anchor.data()) +
         " class=\"" + std::string(style) + "\">" + escaped(text) + "</text>";
}

// The number below a tick; at the right end it stays inside.
std::string x_number(double x, double y, double width, const std::string& text) {
  const double half = 0.5 * kLetter * static_cast<double>(text.size());
  return text_at(std::min(x, width - half - 2.0), y, "middle", "tick", text);
}

std::string css_of(Colour colour) { return std::string(colour.css); }

// As many decimals as a step needs.
int decimals_of(double step) {
  return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
}

double step_of(double from, double to, int count) {
  const double rough = std::abs(to - from) / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

std::string opening_of(std::string_view name, std::string_view kind, Size size,
                       const std::string& title) {
  return "<svg class=\"plot " + std::string(kind) + "\" data-plot=\"" + std::string(name) + "\"" +
         formatted(" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\"", size.width,
                   size.height, size.width, size.height) +
         " role=\"img\" aria-label=\"" + escaped(title) + "\"";
}

std::string scale_attributes(const Axis& x, const Axis& y, Size size, double left) {
  return formatted(" data-x0=\"%.9g\" data-x1=\"%.9g\" data-y0=\"%.9g\" data-y1=\"%.9g\"", x.from,
                   x.to, y.from, y.to) +
         formatted(" data-left=\"%.0f\" data-right=\"%.0f\" data-top=\"%.0f\" data-bottom=\"%.0f\"",
                   left, size.width - kRight, kTop, size.height - kBottom);
}

}  // namespace

Axis axis_over(std::span<const Line> lines, std::string label, double least_span) {
  double least = kUnset, greatest = kUnset;
  for (const Line& line : lines)
    for (const Point& point : line) {
      least = std::fmin(least, point.y);  // fmin and fmax pass over NaN
      greatest = std::fmax(greatest, point.y);
    }
  if (!std::isfinite(least) || !std::isfinite(greatest)) return {0.0, least_span, std::move(label)};
  const double span = std::max(greatest - least, least_span);
  const double middle = 0.5 * (least + greatest);
  const double air = 0.06 * span;
  double from = middle - 0.5 * span - air;
  if (least >= 0.0 && from < 0.0) from = 0.0;
  return {from, from + span + 2.0 * air, std::move(label)};
}

std::vector<double> ticks_of(double from, double to, int count) {
  std::vector<double> ticks;
  const double low = std::min(from, to), high = std::max(from, to);
  if (!(high > low)) return ticks;
  const double step = step_of(low, high, count);
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i += 1.0)
    ticks.push_back(i * step);
  return ticks;
}

Plot::Plot(std::string name, std::string title, Kind kind, Size size, Axis x, Axis y)
    : name_(std::move(name)),
      title_(std::move(title)),
      kind_(kind),
      size_(size),
      left_(kind == Kind::kTime ? kTimeLeft : kPlaneLeft),
      x_(std::move(x)),
      y_(std::move(y)) {
  CHECK(x_.to != x_.from && y_.to != y_.from);
}

double Plot::px(double x) const {
  const double share = std::clamp((x - x_.from) / (x_.to - x_.from), 0.0, 1.0);
  return left_ + share * (size_.width - kRight - left_);
}

double Plot::py(double y) const {
  const double share = std::clamp((y - y_.from) / (y_.to - y_.from), 0.0, 1.0);
  return size_.height - kBottom - share * (size_.height - kBottom - kTop);
}

std::string Plot::path_of(std::span<const Point> points) const {
  std::string path;
  std::size_t in_piece = 0;
  const auto end_piece = [&](double x, double y) {
    if (in_piece == 1) path += formatted("L%.1f %.1f", x + 0.5, y);  // alone, it would be nothing
    in_piece = 0;
  };
  Point last;
  for (const Point& point : points) {
    if (!std::isfinite(point.y)) {
      end_piece(last.x, last.y);
      continue;
    }
    last = {px(point.x), py(point.y)};
    path += formatted("%c%.1f %.1f", in_piece++ == 0 ? 'M' : 'L', last.x, last.y);
  }
  end_piece(last.x, last.y);
  return path;
}

std::string Plot::opening(std::string_view shape, const Mark& mark) const {
  std::string out = "<" + std::string(shape) + " class=\"mark\"";
  if (!mark.name.empty())
    out += " data-name=\"" + escaped(mark.name) + "\" data-unit=\"" + escaped(mark.unit) + "\"";
  return out;
}

void Plot::line(std::span<const Point> points, const Mark& mark) {
  const std::string path = path_of(points);
  if (path.empty()) return;
  if (!mark.name.empty()) legend_.push_back(mark);
  marks_ += opening("path", mark) + " fill=\"none\" stroke=\"" + css_of(mark.colour) + "\"" +
            formatted(" stroke-width=\"%.2g\" stroke-linejoin=\"round\"", mark.width) +
            (mark.dashed ? " stroke-dasharray=\"6 4\"" : "") + " d=\"" + path + "\"/>";
}

void Plot::dots(std::span<const Point> points, const Mark& mark, double size) {
  std::string path;
  for (const Point& point : points)
    if (std::isfinite(point.x) && std::isfinite(point.y))
      path += formatted("M%.1f %.1fh0", px(point.x), py(point.y));
  if (path.empty()) return;
  if (!mark.name.empty()) legend_.push_back(mark);
  marks_ += opening("path", mark) + " fill=\"none\" stroke=\"" + css_of(mark.colour) + "\"" +
            formatted(" stroke-width=\"%.1f\"", size) +
            " stroke-linecap=\"round\" stroke-opacity=\"0.45\" d=\"" + path + "\"/>";
}

void Plot::bars(std::span<const Bar> bars, const Mark& mark) {
  if (!mark.name.empty()) legend_.push_back(mark);
  for (const Bar& bar : bars) {
    if (!std::isfinite(bar.value)) continue;
    const double top = py(bar.value), foot = py(std::max(0.0, y_.from));
    marks_ += opening("rect", mark) + " fill=\"" + css_of(mark.colour) + "\"" +
              formatted(" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"", px(bar.from), top,
                        std::max(px(bar.to) - px(bar.from), 0.5), std::max(foot - top, 0.0)) +
              "><title>" +
              escaped(trimmed(mark.name + " " + significant(bar.value, 4) + " " + mark.unit)) +
              "</title></rect>";
    if (bar.value > y_.to)  // cut off: then it says how tall it is
      marks_ += text_at(0.5 * (px(bar.from) + px(bar.to)), kTop + 14.0, "middle", "cut",
                        significant(bar.value, 3));
  }
}

void Plot::band(double from_x, double to_x, Colour colour, const std::string& label) {
  const double left = px(from_x), width = std::max(px(to_x) - left, 1.0);
  behind_ += formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"", left, kTop,
                       width, size_.height - kBottom - kTop) +
             " fill=\"" + css_of(colour) + "\" fill-opacity=\"0.16\"><title>" + escaped(label) +
             "</title></rect>";
}

void Plot::level(double y, Colour colour, const std::string& label) {
  const double at = py(y);
  behind_ += formatted("<path d=\"M%.1f %.1fH%.1f\"", left_, at, size_.width - kRight) +
             " stroke=\"" + css_of(colour) + "\" stroke-dasharray=\"3 3\"/>" +
             text_at(size_.width - kRight - 4.0, at - 4.0, "end", "note", label);
}

void Plot::circle(double radius_x, Colour colour) {
  behind_ += formatted("<ellipse cx=\"%.1f\" cy=\"%.1f\" rx=\"%.1f\" ry=\"%.1f\"", px(0.0), py(0.0),
                       std::abs(px(radius_x) - px(0.0)), std::abs(py(radius_x) - py(0.0))) +
             " fill=\"none\" stroke=\"" + css_of(colour) + "\"/>";
}

void Plot::sign(double x, double y, std::string_view symbol, Colour colour,
                const std::string& label) {
  marks_ += "<g class=\"sign\" fill=\"" + css_of(colour) + "\"><title>" + escaped(label) +
            "</title>" + formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"9\"/>", px(x), py(y)) +
            text_at(px(x), py(y) + 4.0, "middle", "symbol", std::string(symbol)) + "</g>";
}

void Plot::x_names(std::vector<std::string> names) { x_names_ = std::move(names); }

void Plot::y_names(std::vector<Name> names) { y_names_ = std::move(names); }

std::string Plot::x_axis() const {
  const double foot = size_.height - kBottom;
  std::string out;
  for (std::size_t i = 0; i < x_names_.size(); ++i)
    out += text_at(px(static_cast<double>(i) + 0.5), foot + 16.0, "middle", "tick", x_names_[i]);
  if (x_names_.empty()) {
    const int count = std::max(3, static_cast<int>(size_.width / 95.0));
    const int decimals = decimals_of(step_of(x_.from, x_.to, count));
    for (const double tick : ticks_of(x_.from, x_.to, count))
      out += formatted("<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/>", px(tick), kTop, foot) +
             x_number(px(tick), foot + 16.0, size_.width, number(tick, decimals));
  }
  return out +
         text_at(0.5 * (left_ + size_.width - kRight), foot + 33.0, "middle", "label", x_.label);
}

std::string Plot::y_tick(double y, const std::string& text) const {
  return formatted("<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/>", left_, py(y),
                   size_.width - kRight) +
         text_at(left_ - 7.0, py(y) + 4.0, "end", "tick", text);
}

std::string Plot::y_axis() const {
  std::string out;
  for (const Name& name : y_names_)
    if (name.at >= std::min(y_.from, y_.to) && name.at <= std::max(y_.from, y_.to))
      out += y_tick(name.at, name.text);
  if (!y_names_.empty()) return out;
  const int count = std::max(3, static_cast<int>((size_.height - kTop - kBottom) / 32.0));
  const int decimals = decimals_of(step_of(y_.from, y_.to, count));
  std::size_t letters = 0;
  for (const double tick : ticks_of(y_.from, y_.to, count)) {
    const std::string text = number(tick, decimals);
    letters = std::max(letters, text.size());
    out += y_tick(tick, text);
  }
  const double beside = std::max(54.0, 19.0 + kLetter * static_cast<double>(letters));
  const double middle = 0.5 * (kTop + size_.height - kBottom);
  return out +
         formatted(
             "<text class=\"label\" text-anchor=\"middle\" transform=\"translate(%.0f %.1f) "
             "rotate(-90)\">",
             std::max(left_ - beside, 12.0), middle) +
         escaped(y_.label) + "</text>";
}

std::string Plot::axes() const {
  return x_axis() + y_axis() +
         formatted("<rect class=\"frame\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>",
                   left_, kTop, size_.width - kRight - left_, size_.height - kBottom - kTop);
}

// Behind the title, in the line above the frame.
std::string Plot::legend() const {
  std::string out;
  double x = left_ + static_cast<double>(title_.size()) * (kLetter + 0.6) + 24.0;
  for (const Mark& mark : legend_) {
    out += formatted("<path d=\"M%.1f 15h22\" stroke-width=\"3\"", x) + " stroke=\"" +
           css_of(mark.colour) + "\"" + (mark.dashed ? " stroke-dasharray=\"6 4\"" : "") + "/>" +
           text_at(x + 28.0, 19.0, "start", "tick", mark.name);
    x += 28.0 + static_cast<double>(mark.name.size()) * kLetter + 18.0;
  }
  return out;
}

std::string Plot::svg() const {
  constexpr std::string_view kKinds[]{"time", "plane", "columns"};
  return opening_of(name_, kKinds[static_cast<std::size_t>(kind_)], size_, title_) +
         scale_attributes(x_, y_, size_, left_) + ">" +
         text_at(left_, 19.0, "start", "title", title_) + legend() + behind_ + axes() + marks_ +
         "</svg>\n";
}

std::string lanes_svg(const std::string& name, const std::string& title,
                      std::span<const Lane> lanes, double width, double end_s) {
  constexpr double kRow = 24.0;
  const Size size{width, kTop + kRow * static_cast<double>(lanes.size()) + kBottom};
  const double left = kTimeLeft, right = width - kRight;
  const auto px = [&](double t_s) {
    return left + std::clamp(t_s / end_s, 0.0, 1.0) * (right - left);
  };
  std::string out =
      opening_of(name, "time lanes", size, title) +
      formatted(" data-x0=\"0\" data-x1=\"%.9g\" data-left=\"%.0f\" data-right=\"%.0f\"", end_s,
                left, right) +
      formatted(" data-top=\"%.0f\" data-bottom=\"%.0f\">", kTop, size.height - kBottom) +
      text_at(left, 19.0, "start", "title", title);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const double top = kTop + kRow * static_cast<double>(i);
    out += text_at(left - 8.0, top + 16.0, "end", "tick", lanes[i].name);
    if (lanes[i].pieces.empty())
      out += text_at(left + 6.0, top + 16.0, "start", "note", lanes[i].absent);
    for (const Lane::Piece& piece : lanes[i].pieces) {
      const double wide = std::max(px(piece.to_s) - px(piece.from_s), 1.5);
      out += "<g class=\"mark\" data-name=\"" + escaped(lanes[i].name) + "\" data-label=\"" +
             escaped(piece.label) + "\"><title>" + escaped(piece.label) + "</title>" +
             formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.0f\" stroke=\"#fff\"",
                       px(piece.from_s), top + 2.0, wide, kRow - 4.0) +
             " fill=\"" + css_of(piece.fill) + "\"/>";
      const double word = static_cast<double>(piece.label.size()) * kLetter + 8.0;
      if (wide > word) {
        out += text_at(px(piece.from_s) + 5.0, top + 16.0, "start", "piece", piece.label);
      } else if (lanes[i].pieces.size() == 1) {  // room beside it
        const bool before = px(piece.to_s) + word > right;
        out += text_at(before ? px(piece.from_s) - 5.0 : px(piece.from_s) + wide + 5.0, top + 16.0,
                       before ? "end" : "start", "piece", piece.label);
      }
      out += "</g>";
    }
  }
  for (const double tick : ticks_of(0.0, end_s, 12))
    out += x_number(px(tick), size.height - kBottom + 16.0, width, significant(tick, 6));
  out += text_at(0.5 * (left + right), size.height - kBottom + 33.0, "middle", "label", "time, s");
  return out + "</svg>\n";
}

std::string small_histogram(std::span<const std::uint64_t> counts, double width, double height,
                            double mark_share) {
  double most = 0.0;
  for (const std::uint64_t count : counts)
    most = std::max(most, std::log1p(static_cast<double>(count)));
  std::string path;
  const double step = width / static_cast<double>(counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    const double tall = height * std::log1p(static_cast<double>(counts[i])) / most;
    path += formatted("M%.1f %.1fh%.1fv%.1fh-%.1fz", static_cast<double>(i) * step, height - tall,
                      step, tall, step);
  }
  return "<svg class=\"small\"" +
         formatted(" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\">", width, height,
                   width, height) +
         formatted("<path class=\"grid\" d=\"M%.1f 0V%.0f\"/>", mark_share * width, height) +
         formatted("<path class=\"grid\" d=\"M0 %.1fH%.0f\"/>", height - 0.5, width) +
         "<path class=\"mark\" fill=\"" + css_of(kBlue) + "\" d=\"" + path + "\"/></svg>";
}

}  // namespace pitwall::report
