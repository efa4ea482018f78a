// SPDX-License-Identifier: Apache-2.0
#include "hil/report/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "tests/hil/report/some_run.hpp"

namespace pitwall::report {
namespace {

TEST(Ticks, AreRoundAndInside) {
  std::mt19937 random(3);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
  };
  for (int i = 0; i < 1000; ++i) {
    const double span = std::pow(10.0, between(-6.0, 6.0)), from = 10.0 * span * between(-1.0, 1.0);
    const auto ticks = ticks_of(from, from + span, 6);
    ASSERT_GE(ticks.size(), 2u);
    EXPECT_LE(ticks.size(), 8u);
    for (std::size_t k = 0; k < ticks.size(); ++k) {
      EXPECT_GE(ticks[k], from - 1e-6 * span);
      EXPECT_LE(ticks[k], from + span + 1e-6 * span);
      if (k == 0) continue;
      EXPECT_NEAR(ticks[k] - ticks[k - 1], ticks[1] - ticks[0], 1e-9 * span + 1e-15);
    }
    const double step = ticks[1] - ticks[0];
    const double lead = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    EXPECT_LT(std::min({std::abs(lead - 1), std::abs(lead - 2), std::abs(lead - 5)}), 1e-4) << step;
  }
  EXPECT_EQ(ticks_of(5.0, -5.0, 5).size(), ticks_of(-5.0, 5.0, 5).size()) << "an axis turned round";
}

TEST(AxisOver, HoldsEveryValueAndNeverVanishes) {
  const Axis flat = axis_over({{Line{{0, 3.0}, {1, 3.0}}}}, "x", 0.5);
  EXPECT_LT(flat.from, 3.0);
  EXPECT_GT(flat.to, 3.0);
  EXPECT_EQ(axis_over({{Line{{0, 0.0}, {1, 9.0}}}}, "x", 1.0).from, 0.0) << "no room below zero";
  const Axis none = axis_over({{Line{{0, kUnset}}}}, "x", 2.0);
  EXPECT_EQ(none.to - none.from, 2.0);
}

Plot plain() {
  return Plot{"name", "Title", Plot::Kind::kTime, {600, 200}, {0.0, 10.0, "x"}, {0.0, 1.0, "y"}};
}

TEST(Plot, ALineIsWhereItsValuesAre) {
  Plot plot = plain();
  plot.line(Line{{0.0, 0.0}, {10.0, 1.0}}, {.name = "a", .unit = "m"});
  // Frame: left 124, right 600 - 16, top 30, bottom 200 - 40.
  EXPECT_NE(plot.svg().find("d=\"M124.0 160.0L584.0 30.0\""), std::string::npos) << plot.svg();
}

TEST(Plot, NamesOfTheYAxisStandAtTheirValues) {
  Plot plot = plain();
  plot.y_names({{0.0, "off"}, {1.0, "on & on"}, {2.0, "outside"}});
  const std::string svg = plot.svg();
  EXPECT_NE(svg.find("y=\"164.0\" text-anchor=\"end\" class=\"tick\">off<"), std::string::npos)
      << svg;
  EXPECT_NE(svg.find("y=\"34.0\" text-anchor=\"end\" class=\"tick\">on &amp; on<"),
            std::string::npos);
  EXPECT_EQ(svg.find("outside"), std::string::npos);
  EXPECT_EQ(svg.find(">0.5<"), std::string::npos) << "no numbers beside names";
}

TEST(Plot, TheLabelOfTheYAxisIsBesideLongNumbers) {
  const auto label_x = [](const Axis& y) {
    const std::string svg =
        Plot{"name", "Title", Plot::Kind::kTime, {600, 200}, {0.0, 10.0, "x"}, y}.svg();
    return std::strtod(svg.c_str() + svg.find("translate(") + 10, nullptr);
  };
  EXPECT_EQ(label_x({0.0, 1.0, "y"}), 70.0);
  EXPECT_LT(label_x({-115.011, -115.010, "y"}), 124.0 - 7.0 - 7.0 * 9.0) << "nine letters";
}

TEST(Plot, AGapBreaksTheLineAndOutsideStaysAtTheEdge) {
  Plot plot = plain();
  plot.line(Line{{0.0, 0.0}, {1.0, 0.0}, {2.0, kUnset}, {3.0, 99.0}, {4.0, 0.0}}, {});
  EXPECT_NE(plot.svg().find("d=\"M124.0 160.0L170.0 160.0M262.0 30.0L308.0 160.0\""),
            std::string::npos)
      << plot.svg();
}

TEST(Plot, NothingToDrawLeavesNoMark) {
  Plot plot = plain();
  plot.line(Line{{0.0, kUnset}}, {.name = "a", .unit = "m"});
  plot.dots(Line{{kUnset, 1.0}}, {.name = "b", .unit = "m"}, 3.0);
  plot.bars({}, {});
  EXPECT_EQ(count(plot.svg(), "class=\"mark\""), 0u);
}

TEST(Plot, ABarThatIsCutOffSaysHowTallItIs) {
  Plot plot = plain();
  const std::vector<Bar> bars{{1.0, 2.0, 0.5}, {3.0, 4.0, 219.0}};
  plot.bars(bars, {.name = "a", .unit = "m"});
  EXPECT_EQ(count(plot.svg(), ">219<"), 1u);
  EXPECT_EQ(count(plot.svg(), ">0.5<"), 0u + count(plain().svg(), ">0.5<"));
}

TEST(Plot, NoNameBreaksOut) {
  Plot plot{"n", "<b>", Plot::Kind::kPlane, {600, 200}, {0, 1, "\"x"}, {0, 1, "<y>"}};
  plot.line(Line{{0.0, 0.0}, {1.0, 1.0}}, {.name = "\"><script>", .unit = "'"});
  plot.band(0.0, 1.0, kBlue, "<i>");
  plot.sign(0.5, 0.5, "<", kBlue, "<u>");
  for (const char* tag : {"<b>", "<y>", "<script>", "<i>", "<u>"})
    EXPECT_EQ(plot.svg().find(tag), std::string::npos) << tag;
}

TEST(Lanes, APieceHasItsWordWhereItFits) {
  const std::vector<Lane> lanes{
      {"mode", {{0.0, 9.0, "driving", kGreen}, {9.0, 9.1, "stop", kBlue}}, ""},
      {"flag", {}, "none"}};
  const std::string svg = lanes_svg("states", "States", lanes, 1200.0, 10.0);
  EXPECT_EQ(count(svg, "class=\"mark\""), 2u);
  EXPECT_EQ(count(svg, ">driving</text>"), 1u);
  EXPECT_EQ(count(svg, ">stop</text>"), 0u) << "too narrow for its word";
  EXPECT_EQ(count(svg, ">none</text>"), 1u);

  const std::vector<Lane> one{{"fault", {{9.9, 10.0, "stuck", kBlue}}, ""}};
  const std::string beside = lanes_svg("states", "States", one, 1200.0, 10.0);
  EXPECT_NE(beside.find("text-anchor=\"end\" class=\"piece\">stuck"), std::string::npos);
}

TEST(SmallHistogram, OneBarForEachBinThatHoldsSomething) {
  const std::vector<std::uint64_t> counts{0, 3, 0, 1000};
  EXPECT_EQ(count(small_histogram(counts, 100.0, 20.0, 0.5), "z"), 2u);
}

}  // namespace
}  // namespace pitwall::report
