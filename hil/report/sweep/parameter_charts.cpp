// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/parameter_charts.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hil/report/absent.hpp"
#include "hil/report/html.hpp"
#include "hil/report/plot.hpp"
#include "hil/report/sweep/parameter_axis.hpp"
#include "hil/report/text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

constexpr Size kScatter{592.0, 250.0};

struct Judged {
  std::size_t number = 0;  // of the case
  double margin = kUnset;
};

struct Drawn {
  std::vector<Judged> passed, failed, without_margin;
  std::size_t all = 0;
};

// At most so many, evenly.
std::vector<Judged> thinned_to(const std::vector<Judged>& cases, std::size_t most) {
  if (cases.size() <= most) return cases;
  std::vector<Judged> out;
  for (std::size_t i = 0; i < most; ++i) out.push_back(cases[i * cases.size() / most]);
  return out;
}

Drawn drawn_of(CaseResults results, const std::string& expectation) {
  Drawn drawn;
  for (const sweep::CaseResult& result : results)
    for (const sweep::ExpectationMargin& of : result.margins) {
      if (of.text != expectation) continue;
      const bool is_finite = std::isfinite(of.margin);
      if (of.pass && !is_finite) continue;
      (of.pass     ? drawn.passed
       : is_finite ? drawn.failed
                   : drawn.without_margin)
          .push_back({result.number, of.margin});
    }
  drawn.all = drawn.passed.size() + drawn.failed.size() + drawn.without_margin.size();
  std::size_t room = kDotsMost;
  for (std::vector<Judged>* part : {&drawn.failed, &drawn.without_margin, &drawn.passed}) {
    *part = thinned_to(*part, room);
    room -= part->size();
  }
  return drawn;
}

Line points_of(const sweep::Cases& cases, const std::vector<Judged>& judged,
               std::size_t parameter) {
  Line points;
  for (const Judged& of : judged)
    points.push_back({number_of(cases.at(of.number).settings[parameter].value), of.margin});
  return points;
}

std::string chart_of_parameter(const sweep::Cases& cases, const Drawn& drawn, std::size_t parameter,
                               const ParameterAxis& axis) {
  constexpr double kDot = 5.0, kAir = 0.03;
  const Line passed = points_of(cases, drawn.passed, parameter),
             failed = points_of(cases, drawn.failed, parameter);
  Line without = points_of(cases, drawn.without_margin, parameter);
  const std::vector<Line> lines{passed, failed, Line{{0.0, 0.0}}};
  const Axis margin = axis_over(lines, "margin", 1e-6);
  for (Point& point : without) point.y = margin.from;
  const double air = kAir * (axis.to() - axis.from());
  Plot plot(formatted("parameter%zu", parameter + 1), "margin by " + axis.path(),
            Plot::Kind::kPlane, kScatter, {axis.from() - air, axis.to() + air, axis.path()},
            margin);
  plot.level(0.0, kInk, "");
  plot.dots(passed, {.colour = kBlue, .name = {}, .unit = {}}, kDot);
  plot.dots(failed, {.colour = kVermillion, .name = {}, .unit = {}}, kDot + 1.0);
  plot.dots(without, {.colour = kInk, .name = {}, .unit = {}}, kDot + 1.0);
  return plot.svg();
}

std::string explanation(const Drawn& drawn, const std::string& expectation) {
  std::string out = "<h3>" + escaped(expectation) + "</h3>\n<p class=\"legend\">";
  const auto add = [&out](Colour colour, const char* what, std::size_t count) {
    out += formatted("<span><i style=\"background:%s\"></i>%s: %zu</span> ",
                     std::string(colour.css).c_str(), what, count);
  };
  add(kBlue, "passed", drawn.passed.size());
  add(kVermillion, "failed", drawn.failed.size());
  if (!drawn.without_margin.empty())
    add(kInk, "failed without a margin, at the lower edge", drawn.without_margin.size());
  out += "</p>\n";
  const std::size_t dots = drawn.passed.size() + drawn.failed.size() + drawn.without_margin.size();
  if (dots < drawn.all)
    out +=
        note(formatted("%zu of %zu cases are drawn: those that failed first, then the others, "
                       "evenly by number.",
                       dots, drawn.all));
  return out;
}

}  // namespace

std::string parameter_charts(const sweep::Cases& cases, CaseResults results,
                             const std::string& expectation) {
  const Drawn drawn = drawn_of(results, expectation);
  const std::vector<sweep::Parameter>& parameters = cases.plan().parameters;
  std::vector<std::string> charts;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    if (const ParameterAxis axis{parameters[k]}; axis.is_numeric())
      charts.push_back(chart_of_parameter(cases, drawn, k, axis));
  if (charts.empty())
    return absent("parameters", "Margin by parameter", "no parameter has different numbers");
  return explanation(drawn, expectation) + in_two_columns(charts);
}

}  // namespace pitwall::report
