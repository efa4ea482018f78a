// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/bank_picture.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/raceline/courses.hpp"
#include "vehicle/raceline/bank_builder.hpp"

namespace pitwall::raceline {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

struct Drawing {
  world::TrackDescription description = stadium();
  world::TrackMap map = valid(world::TrackMap::build(description));
  RacelineBank bank = valid(build_bank(description, map, {.car_width_m = 2.0}));
};

TEST(BankPicture, ShowsEachLineThreeTimes) {
  const Drawing drawing;
  const std::string svg = picture_of(drawing.bank, drawing.map);
  EXPECT_EQ(svg.substr(0, 4), "<svg");
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
  EXPECT_EQ(count_of(svg, "class=\"line\""), drawing.bank.lines.size());
  EXPECT_EQ(count_of(svg, "stroke-width=\"1.3\""), 3 * drawing.bank.lines.size());
  EXPECT_EQ(count_of(svg, "class=\"wall\""), 4U);
  EXPECT_EQ(count_of(svg, "class=\"pit\""), 6U);  // the unrolled one lies across the start
  for (const Raceline& line : drawing.bank.lines)
    EXPECT_NE(svg.find(">" + line.name + "<"), std::string::npos) << line.name;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(BankPicture, ShowsSpeedsAndLapTimes) {
  Drawing drawing;
  for (Raceline& line : drawing.bank.lines) {
    line.lap.assign(line.points.size(),
                    LapPoint{.speed_mps = 50.0, .accel_mps2 = 0.0, .time_s = 0.0, .gear = 3});
    line.lap_s = 61.25;
  }
  const std::string svg = picture_of(drawing.bank, drawing.map);
  EXPECT_EQ(count_of(svg, "stroke-width=\"1.3\""), 4 * drawing.bank.lines.size());
  EXPECT_EQ(count_of(svg, ">61.250<"), drawing.bank.lines.size());
}

// Every coordinate of the picture lies on it: the first of each pair within the width.
TEST(BankPicture, LiesWithinItsSheet) {
  const Drawing drawing;
  const std::string svg = picture_of(drawing.bank, drawing.map);
  std::size_t pairs = 0;
  for (std::size_t at = svg.find("points=\""); at != std::string::npos;
       at = svg.find("points=\"", at + 1)) {
    const std::size_t end = svg.find('"', at + 8);
    std::istringstream row(svg.substr(at + 8, end - at - 8));
    double x = 0.0, y = 0.0;
    char comma = ' ';
    while (row >> x >> comma >> y) {
      EXPECT_TRUE(x >= 0.0 && x <= 1600.0 && y >= 0.0) << x << "," << y;
      ++pairs;
    }
  }
  EXPECT_GT(pairs, 10'000U);
}

TEST(BankPicture, LeavesMarkupOfNamesOut) {
  Drawing drawing;
  drawing.bank.track = "<script>&";
  drawing.bank.lines[0].name = "a\"><b";
  const std::string svg = picture_of(drawing.bank, drawing.map);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  EXPECT_EQ(svg.find("<b"), std::string::npos);
  EXPECT_EQ(svg.find('&'), std::string::npos);
}

}  // namespace
}  // namespace pitwall::raceline
