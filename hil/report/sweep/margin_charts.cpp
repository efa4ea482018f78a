// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/margin_charts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "hil/report/absent.hpp"
#include "hil/report/html.hpp"
#include "hil/report/plot.hpp"
#include "hil/report/sweep/case_table.hpp"
#include "hil/report/text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

using sweep::MarginSpread;

constexpr std::size_t kColumns = 40;
constexpr double kLinearMost = 100.0;  // cases in a column; with more the heights are logarithmic
constexpr int kDigits = 4;
constexpr Size kChart{592.0, 230.0};

// Columns of equal width, one of which begins at 0 if 0 is among them.
struct Columns {
  double from = 0.0, to = 1.0;
  std::size_t count = 1;
};

// 0 is shown unless it is so far away that the margins would be one column. Margins that differ by
// rounding alone are equal.
Columns columns_over(double least, double greatest) {
  constexpr double kFar = 10.0;  // spans
  constexpr double kEqual = 1e-6;
  if (greatest - least < kEqual * std::max(std::abs(least), std::abs(greatest))) greatest = least;
  const double span = greatest - least;
  if (least > 0.0 && least < kFar * span) least = 0.0;
  if (greatest < 0.0 && -greatest < kFar * span) greatest = 0.0;
  if (!(greatest > least)) {
    const double half = std::max(0.5, 0.05 * std::abs(least));
    least -= half, greatest += half;
  }
  const double width = (greatest - least) / static_cast<double>(kColumns);
  const double from = std::floor(least / width) * width;
  const auto count = static_cast<std::size_t>(std::ceil((greatest - from) / width - 1e-6));
  return {from, from + width * static_cast<double>(count), count};
}

class Histogram {
 public:
  Histogram(const MarginSpread& spread, const MarginSpread* before)
      : spread_(spread),
        before_(before != nullptr && !before->all.empty() ? before : nullptr),
        columns_(columns_over(
            before_ ? std::min(spread.least(), before_->least()) : spread.least(),
            before_ ? std::max(spread.all.back(), before_->all.back()) : spread.all.back())) {
    for (const std::vector<std::uint64_t>& counts :
         {counts_of(spread_.all), counts_of(before_ ? before_->all : std::vector<double>{})})
      for (const std::uint64_t count : counts) most_ = std::max(most_, static_cast<double>(count));
  }

  std::string svg(const std::string& name) const {
    const double top = 1.08 * height_of(most_);
    Plot plot(name, "cases by margin", Plot::Kind::kBars, kChart, axis_of_margin(),
              {0.0, top, "cases"});
    if (is_logarithmic()) plot.y_names(names());
    plot.bars(bars_of(spread_.all), {.colour = kSky, .name = {}, .unit = unit()});
    if (!spread_.failed.empty())
      plot.bars(bars_of(spread_.failed), {.colour = kVermillion, .name = {}, .unit = unit()});
    if (before_)
      plot.line(outline_of(before_->all), {.colour = kInk, .name = {}, .unit = {}, .width = 1.2});
    const auto upright = [&](double margin, Colour colour, double width, bool dashed) {
      const Line line{{margin, 0.0}, {margin, top}};
      plot.line(line, {.colour = colour, .name = {}, .unit = {}, .width = width, .dashed = dashed});
    };
    if (shows_zero()) upright(0.0, kInk, 2.5, false);
    upright(spread_.least(), kPurple, 1.8, true);
    upright(spread_.one_in_twenty(), kBlue, 1.8, true);
    upright(spread_.median(), kGreen, 1.8, true);
    return plot.svg();
  }

  bool shows_zero() const { return columns_.from <= 0.0 && columns_.to >= 0.0; }
  bool is_logarithmic() const { return most_ > kLinearMost; }

 private:
  // Half a column beside the first and the last, so that no mark lies on the frame.
  Axis axis_of_margin() const {
    const double half = 0.5 * (edge(1) - edge(0));
    return {columns_.from - half, columns_.to + half, "margin, unit of the signal"};
  }
  double height_of(double count) const {
    return is_logarithmic() ? std::log10(1.0 + count) : count;
  }
  const char* unit() const { return is_logarithmic() ? "log10(1 + cases)" : "cases"; }

  std::vector<std::uint64_t> counts_of(const std::vector<double>& margins) const {
    return histogram(margins, columns_.from, columns_.to, columns_.count);
  }
  double edge(std::size_t column) const {
    return columns_.from + (columns_.to - columns_.from) * static_cast<double>(column) /
                               static_cast<double>(columns_.count);
  }

  std::vector<Bar> bars_of(const std::vector<double>& margins) const {
    const std::vector<std::uint64_t> counts = counts_of(margins);
    std::vector<Bar> bars;
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (counts[i] > 0)
        bars.push_back({edge(i), edge(i + 1), height_of(static_cast<double>(counts[i]))});
    return bars;
  }

  Line outline_of(const std::vector<double>& margins) const {
    const std::vector<std::uint64_t> counts = counts_of(margins);
    Line line;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      line.push_back({edge(i), height_of(static_cast<double>(counts[i]))});
      line.push_back({edge(i + 1), line.back().y});
    }
    return line;
  }

  std::vector<Plot::Name> names() const {
    std::vector<Plot::Name> names{{0.0, "0"}};
    for (double count = 10.0; count <= most_; count *= 10.0)
      names.push_back({height_of(count), number(count, 0)});
    return names;
  }

  const MarginSpread& spread_;
  const MarginSpread* before_;
  Columns columns_;
  double most_ = 1.0;
};

std::string swatch(Colour colour, const std::string& html) {
  return "<span><i style=\"background:" + std::string(colour.css) + "\"></i>" + html + "</span> ";
}

std::string figures(const SweepRun& run, const MarginSpread& spread) {
  std::string out = "<p class=\"legend\">";
  if (!spread.all.empty())
    out += swatch(kPurple, "least: " + significant(spread.least(), kDigits) + " (case " +
                               case_link(run, spread.least_in) + ")") +
           swatch(kBlue, "1 in 20: " + significant(spread.one_in_twenty(), kDigits)) +
           swatch(kGreen, "median: " + significant(spread.median(), kDigits));
  out += formatted("<span>failed: %zu of %zu</span> ", spread.failures,
                   spread.all.size() + spread.not_finite);
  if (spread.not_finite > 0)
    out += formatted("<span>without a margin, not drawn: %zu</span>", spread.not_finite);
  return out + "</p>\n";
}

std::string chart_of(const SweepRun& run, const MarginSpread& spread, const MarginSpread* before,
                     std::size_t place) {
  const std::string name = formatted("margin%zu", place + 1);
  std::string out = "<h3>" + escaped(spread.text) + "</h3>\n";
  if (spread.all.empty())
    return out + absent(name, "Margin", "in no case did it come to be judged") +
           figures(run, spread);
  const Histogram histogram{spread, before};
  out += histogram.svg(name) + figures(run, spread);
  if (!histogram.shows_zero()) out += note("The limit, 0, is outside the axis.");
  if (histogram.is_logarithmic()) out += note("Heights are logarithmic.");
  return out;
}

}  // namespace

std::vector<MarginSpread> spreads_by_failures(CaseResults results) {
  std::vector<MarginSpread> spreads = sweep::margin_spreads(results);
  std::ranges::stable_sort(spreads, [](const MarginSpread& a, const MarginSpread& b) {
    if (a.failures != b.failures) return a.failures > b.failures;
    return std::pair{a.all.empty(), a.least()} < std::pair{b.all.empty(), b.least()};
  });
  return spreads;
}

const MarginSpread* spread_of(const std::vector<MarginSpread>& spreads,
                              const std::string& expectation) {
  const auto found = std::ranges::find(spreads, expectation, &MarginSpread::text);
  return found == spreads.end() ? nullptr : &*found;
}

std::string margin_charts(const SweepRun& run, const std::vector<MarginSpread>& spreads,
                          const std::vector<MarginSpread>& before) {
  if (spreads.empty()) return absent("margins", "Margins", "no expectation was judged");
  std::string out = "<p class=\"legend\">" + swatch(kSky, "all cases") +
                    swatch(kVermillion, "of these failed") + swatch(kInk, "limit, at 0");
  if (run.baseline) out += "<span>thin outline: all cases of the baseline</span>";
  out += "</p>\n";
  std::vector<std::string> charts;
  for (std::size_t i = 0; i < std::min(spreads.size(), kExpectationsShown); ++i)
    charts.push_back(chart_of(run, spreads[i], spread_of(before, spreads[i].text), i));
  out += in_two_columns(charts);
  if (spreads.size() > kExpectationsShown)
    out += note(formatted("%zu more expectations, with fewer failures, are not shown.",
                          spreads.size() - kExpectationsShown));
  return out;
}

}  // namespace pitwall::report
