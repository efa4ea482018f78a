// SPDX-License-Identifier: Apache-2.0
#include "hil/report/signal_plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "tests/hil/report/some_run.hpp"
#include "tests/hil/report/some_signals.hpp"

namespace pitwall::report {
namespace {

class SignalPlot : public testing::Test {
 protected:
  std::string svg_of(const std::vector<ChosenSignal>& chosen, const replay::CanLog& log) {
    series_ = signal_series(log, chosen, {0.0, 1.0});
    return signal_svg(
        {.title = "a <log>", .caption = {"0 s is & so"}, .series = series_, .to_s = 1.0});
  }
  ChosenSignal chosen(const std::string& message, const std::string& signal) const {
    return some_signal(database_, message, signal);
  }

  can::Database database_ = some_database();
  std::vector<SignalSeries> series_;
};

double attribute(const std::string& svg, const std::string& name) {
  const std::size_t at = svg.find(name + "=\"");
  EXPECT_NE(at, std::string::npos) << name;
  return std::strtod(svg.c_str() + at + name.size() + 2, nullptr);
}

// The points of the line called `name`, in the units of its axes.
std::vector<Point> drawn(const std::string& svg, const std::string& name) {
  const std::size_t mark = svg.find("data-name=\"" + name + "\"");
  EXPECT_NE(mark, std::string::npos) << name;
  const std::string panel = svg.substr(svg.rfind("<svg", mark));
  const auto get = [&panel](const char* of) { return attribute(panel, of); };
  std::vector<Point> points;
  const char* at = svg.c_str() + svg.find(" d=\"", mark) + 4;
  while (*at == 'M' || *at == 'L') {
    char* end = nullptr;
    const double px = std::strtod(at + 1, &end), py = std::strtod(end, &end);
    points.push_back(
        {get("data-x0") + (px - get("data-left")) / (get("data-right") - get("data-left")) *
                              (get("data-x1") - get("data-x0")),
         get("data-y0") + (py - get("data-bottom")) / (get("data-top") - get("data-bottom")) *
                              (get("data-y1") - get("data-y0"))});
    at = end;
  }
  return points;
}

TEST_F(SignalPlot, TheLineIsAtTheValuesOfTheFrames) {
  const auto points = drawn(svg_of({chosen("Drive", "Speed")}, some_log()), "Speed");
  ASSERT_EQ(points.size(), kSomeFrames);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i].x, 0.01 * static_cast<double>(i), 1e-4);  // a tenth of a pixel
    EXPECT_NEAR(points[i].y, speed_at(i), 0.4) << i;                // of 400 km/h on 170 pixels
  }
}

TEST_F(SignalPlot, ManyFramesKeepTheirPeaks) {
  replay::CanLog log = some_log();
  const replay::LoggedFrame frame = log.frames.front();
  log.frames.clear();
  for (int i = 0; i < 100'000; ++i) {
    log.frames.push_back(frame);
    log.frames.back().at.ns += i * std::int64_t{10'000};
  }
  log.frames[54'321].frame.data[1] = 0x10;  // one frame of 4096: 194.8 km/h
  const auto points = drawn(svg_of({chosen("Drive", "Speed")}, log), "Speed");
  EXPECT_LT(points.size(), 5000u);
  const auto peak = std::ranges::max_element(points, {}, &Point::y);
  EXPECT_NEAR(peak->x, 0.54321, 1e-3);
  EXPECT_NEAR(peak->y, 194.8, 2.0);
}

TEST_F(SignalPlot, SignalsOfOneUnitShareAPanelAndTheOthersDoNot) {
  const std::string svg = svg_of({chosen("Drive", "Speed"), chosen("Drive", "Gear"),
                                  chosen("Drive", "Wheel"), chosen("Drive", "Odd")},
                                 some_log());
  EXPECT_EQ(count(svg, "data-plot=\"signals\""), 3u);
  EXPECT_EQ(count(svg, ">km/h</text>"), 1u);
  EXPECT_EQ(drawn(svg, "Wheel").size(), kSomeFrames);
  EXPECT_EQ(count(svg, "xmlns"), 1u) << "one file, which needs nothing from outside";
  EXPECT_NE(svg.find("a &lt;log&gt;"), std::string::npos);
  EXPECT_NE(svg.find("0 s is &amp; so"), std::string::npos);
}

TEST_F(SignalPlot, ASignalThatMovesIsNotMadeAFlatLineByAnother) {
  replay::CanLog log = some_log();
  for (std::size_t i = 0; i < kSomeFrames; ++i) {  // 0 to 5 km/h beside 400
    log.frames[i].frame.data[2] = static_cast<std::uint8_t>(200 + i);
    log.frames[i].frame.data[3] = 0;
  }
  const std::vector<ChosenSignal> both{chosen("Drive", "Speed"), chosen("Drive", "Wheel")};
  EXPECT_EQ(count(svg_of(both, log), "data-plot=\"signals\""), 2u);
  for (replay::LoggedFrame& logged : log.frames) logged.frame.data[2] = 200;  // a set point
  EXPECT_EQ(count(svg_of(both, log), "data-plot=\"signals\""), 1u);
}

TEST_F(SignalPlot, StatesHaveTheirNamesAndSteps) {
  const std::string svg = svg_of({chosen("Drive", "Gear")}, some_log());
  EXPECT_NE(svg.find(">park &amp; &lt;wait&gt;</text>"), std::string::npos) << "13 letters";
  EXPECT_NE(svg.find(">drive</text>"), std::string::npos);
  EXPECT_NE(svg.find(">a name that is\u2026</text>"), std::string::npos);
  for (const Point& point : drawn(svg, "Gear"))
    EXPECT_NEAR(point.y, std::round(point.y), 0.02) << "nothing is between two states";

  replay::CanLog log = some_log();
  log.frames[5].frame.data[4] = 200;  // has no name: then it is a quantity
  const std::string numbers = svg_of({chosen("Drive", "Gear")}, log);
  EXPECT_EQ(numbers.find(">drive</text>"), std::string::npos);
}

TEST_F(SignalPlot, HugeAndTinyAndConstantValuesHaveAxes) {
  for (const double value : {0.0, 1e-300, 5.0, -1e99, 1e100}) {
    replay::CanLog log = some_log();
    for (std::size_t i = 0; i < log.frames.size(); ++i) {
      can::Frame& frame = log.frames[i].frame;
      frame.id = 32;
      const double now = i == 7 ? std::nextafter(value, std::numeric_limits<double>::max()) : value;
      const auto bits = std::bit_cast<std::uint64_t>(now);
      for (std::size_t k = 0; k < 8; ++k) frame.data[k] = static_cast<std::uint8_t>(bits >> 8 * k);
    }
    const std::string svg = svg_of({chosen("Wild", "Real")}, log);
    EXPECT_GE(count(svg, "class=\"grid\""), 4u) << value;
    EXPECT_EQ(svg.find("nan"), std::string::npos) << value;
  }
}

TEST_F(SignalPlot, ThePageHoldsTheSamePlots) {
  series_ = signal_series(some_log(), {{chosen("Drive", "Speed")}}, {0.0, 1.0});
  std::string page = signal_page({.title = "a", .caption = {"b"}, .series = series_, .to_s = 1.0});
  EXPECT_EQ(drawn(page, "Speed").size(), kSomeFrames);
  const std::string name_space = "http://www.w3.org/2000/svg";  // of the script, no address
  if (const std::size_t at = page.find(name_space); at != std::string::npos)
    page.erase(at, name_space.size());
  for (const char* const outside : {"http", "src=", "@import", "url("})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

}  // namespace
}  // namespace pitwall::report
