// SPDX-License-Identifier: Apache-2.0
#include "hil/report/signal_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hil/report/html.hpp"
#include "hil/report/page_assets.hpp"
#include "hil/report/plot.hpp"
#include "hil/report/text.hpp"
#include "hil/report/time_charts.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

constexpr std::array<Colour, kPanelSignals> kColours{kBlue, kVermillion, kGreen, kPurple};
constexpr std::size_t kBuckets = 1060;      // about one for each pixel
constexpr std::size_t kPanelLetters = 100;  // of the names in a legend
constexpr std::size_t kNameLetters = 15;    // of a value's name beside the axis
constexpr std::size_t kDottedPoints = 150;  // up to here each value is a dot, too
constexpr double kFlat = 20.0;              // a range so much smaller than that of its panel
constexpr double kHeight = 240.0, kMaxHeight = 520.0, kRow = 20.0, kFrame = 70.0;

struct Panel {
  std::vector<const SignalSeries*> series;
  bool is_named = false;
};

struct Drawn {
  std::string svg;
  double height = 0.0;
};

double physical_of_name(const can::Signal& signal, const can::ValueName& name) {
  return static_cast<double>(name.value) * signal.layout.scale + signal.layout.offset;
}

// True where each value of the line has a name: then these are states, not a quantity.
bool has_only_names(const SignalSeries& series) {
  const can::Signal& signal = *series.chosen.signal;
  std::vector<double> named;
  for (const can::ValueName& name : signal.values) named.push_back(physical_of_name(signal, name));
  std::ranges::sort(named);
  return !named.empty() && std::ranges::all_of(series.points, [&named](const Point& point) {
    return !std::isfinite(point.y) || std::ranges::binary_search(named, point.y);
  });
}

struct Extremes {
  double least = kUnset, greatest = kUnset;

  void add(const Line& line) {
    for (const Point& point : line) {
      least = std::fmin(least, point.y);  // fmin and fmax pass over NaN
      greatest = std::fmax(greatest, point.y);
    }
  }
  double range() const { return greatest - least; }
};

Extremes extremes_of(const Line& line) {
  Extremes out;
  out.add(line);
  return out;
}

bool is_one_message(std::span<const SignalSeries* const> all) {
  const SignalSeries& first = *all.front();
  return std::ranges::all_of(all, [&first](const SignalSeries* series) {
    return series->chosen.message == first.chosen.message && series->channel.empty();
  });
}

// True where the legend holds every name and no signal that moves would be a flat line.
bool fits_together(std::span<const SignalSeries* const> all) {
  const bool has_short_names = is_one_message(all);
  Extremes together;
  for (const SignalSeries* const series : all) together.add(series->points);
  std::size_t letters = 0;
  for (const SignalSeries* const series : all) {
    letters += has_short_names ? series->chosen.signal->name.size() : series->name().size();
    const double range = extremes_of(series->points).range();
    if (range > 0.0 && range * kFlat < together.range()) return false;
  }
  return all.size() <= kPanelSignals && letters <= kPanelLetters;
}

bool takes(const Panel& panel, const SignalSeries& series) {
  const std::string& unit = series.chosen.signal->unit;
  if (panel.is_named || unit.empty() || panel.series.front()->chosen.signal->unit != unit)
    return false;
  auto all = panel.series;
  all.push_back(&series);
  return fits_together(all);
}

std::vector<Panel> panels_of(std::span<const SignalSeries> all) {
  std::vector<Panel> panels;
  for (const SignalSeries& series : all) {
    if (series.values == 0) continue;
    const bool is_named = has_only_names(series);
    const auto with = std::ranges::find_if(
        panels, [&](const Panel& panel) { return !is_named && takes(panel, series); });
    if (with != panels.end()) {
      with->series.push_back(&series);
    } else {
      panels.push_back({{&series}, is_named});
    }
  }
  return panels;
}

// Held until the next value: no state lies between two states.
Line stepped(const Line& points) {
  Line out;
  for (const Point& point : points) {
    if (!out.empty() && std::isfinite(point.y) && std::isfinite(out.back().y))
      out.push_back({point.x, out.back().y});
    out.push_back(point);
  }
  return out;
}

// Of an axis: what a constant needs, and so much that its ticks differ as doubles.
double least_span_of(const std::vector<Line>& lines, double scale) {
  double greatest = 0.0, first = kUnset;
  bool is_constant = true;
  for (const Line& line : lines)
    for (const Point& point : line) {
      if (!std::isfinite(point.y)) continue;
      if (!std::isfinite(first)) first = point.y;
      is_constant = is_constant && point.y == first;
      greatest = std::max(greatest, std::abs(point.y));
    }
  constexpr double kRelative = 1e-9, kAbsolute = 1e-12;
  const double least = std::max(kRelative * greatest, kAbsolute);
  return is_constant ? std::max({least, 0.1 * greatest, 2.0 * std::abs(scale)}) : least;
}

// Cut in front of a character of UTF-8, so that it fits beside the axis.
std::string short_name(std::string name) {
  if (name.size() <= kNameLetters) return name;
  std::size_t end = kNameLetters - 1;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
  return name.substr(0, end) + "\u2026";
}

// Those within the values, at most as many as fit below each other.
std::vector<Plot::Name> names_for(const can::Signal& signal, const Line& line) {
  const auto [least, greatest] = extremes_of(line);
  std::vector<Plot::Name> names;
  for (const can::ValueName& name : signal.values) {
    const double at = physical_of_name(signal, name);
    if (at >= least && at <= greatest) names.push_back({at, short_name(name.name)});
  }
  std::ranges::sort(names, {}, &Plot::Name::at);
  const double room = (greatest - least) * kRow / (kMaxHeight - kFrame) * 0.7;
  std::vector<Plot::Name> out;
  for (Plot::Name& name : names)
    if (out.empty() || name.at - out.back().at >= room) out.push_back(std::move(name));
  return out;
}

struct PanelText {
  std::string title, label;
  bool has_short_names = false;
};

PanelText text_of(const Panel& panel) {
  const ChosenSignal& first = panel.series.front()->chosen;
  const bool is_one = is_one_message(panel.series);
  const std::string& unit = first.signal->unit;
  return {.title = is_one ? first.message->name : std::string(),
          .label = unit.empty() ? "no unit" : unit,
          .has_short_names = is_one};
}

Drawn draw(const Panel& panel, const SignalPlot& plot) {
  std::vector<Line> lines;
  for (const SignalSeries* const series : panel.series)
    lines.push_back(thinned(panel.is_named ? stepped(series->points) : series->points, plot.from_s,
                            plot.to_s, kBuckets));
  const can::Signal& first = *panel.series.front()->chosen.signal;
  std::vector<Plot::Name> names;
  if (panel.is_named) names = names_for(first, lines.front());
  const double height =
      std::clamp(kFrame + kRow * static_cast<double>(names.size()), kHeight, kMaxHeight);
  const PanelText text = text_of(panel);
  Plot drawing("signals", text.title, Plot::Kind::kTime, {kPageWidth, height},
               {plot.from_s, plot.to_s, "time from the start of the log, s"},
               axis_over(lines, text.label, least_span_of(lines, first.layout.scale)));
  drawing.y_names(std::move(names));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const SignalSeries& series = *panel.series[i];
    const can::Signal& signal = *series.chosen.signal;
    const Colour colour = kColours[i];
    drawing.line(lines[i], {.colour = colour,
                            .name = text.has_short_names ? signal.name : series.name(),
                            .unit = signal.unit});
    if (series.points.size() <= kDottedPoints)
      drawing.dots(series.points, {.colour = colour, .name = {}, .unit = {}}, 5.0);
  }
  return {drawing.svg(), height};
}

}  // namespace

std::string signal_svg(const SignalPlot& plot) {
  constexpr double kTitle = 30.0, kLine = 18.0, kSide = 8.0;
  double y = kTitle;
  std::string body;
  for (const std::string& line : plot.caption) {
    body +=
        formatted("<text x=\"%.0f\" y=\"%.0f\">", kSide, y + 12.0) + escaped(line) + "</text>\n";
    y += kLine;
  }
  for (const Panel& panel : panels_of(plot.series)) {
    const Drawn drawn = draw(panel, plot);
    body += formatted("<g transform=\"translate(0 %.0f)\">", y) + drawn.svg + "</g>\n";
    y += drawn.height;
  }
  std::string out = formatted(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
      "viewBox=\"0 0 %.0f %.0f\">\n<style>",
      kPageWidth, y, kPageWidth, y);
  out += kPlotStyle;
  return out + "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
         formatted("<text class=\"title\" x=\"%.0f\" y=\"20\">", kSide) + escaped(plot.title) +
         "</text>\n" + body + "</svg>\n";
}

std::string signal_page(const SignalPlot& plot) {
  std::string out = "<h1>" + escaped(plot.title) + "</h1>\n";
  for (const std::string& line : plot.caption) out += note(line);
  for (const Panel& panel : panels_of(plot.series)) out += draw(panel, plot).svg;
  return document(plot.title, out);
}

}  // namespace pitwall::report
