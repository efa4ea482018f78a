// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/profile/lap_road.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/vehicle/envelope/roads.hpp"
#include "tests/vehicle/raceline/courses.hpp"

namespace pitwall::raceline {
namespace {

// Along the reference line of the stadium, through the pit lane or not.
Raceline along(const world::TrackMap& map, Region region) {
  const auto count = static_cast<std::size_t>(map.length_m());
  Raceline line{"line", region, map.length_m(), {}, {}, kUnset};
  for (std::size_t i = 0; i < count; ++i) {
    const world::TrackPoint p =
        map.at(map.length_m() * static_cast<double>(i) / static_cast<double>(count));
    line.points.push_back({p.x_m, p.y_m, p.yaw_rad, p.curvature_per_m, p.bank_rad});
  }
  return line;
}

struct Stadium {
  world::TrackMap map = valid(world::TrackMap::build(stadium()));
  Lanes lanes{map};
  envelope::EnvelopeTable table{envelope::testing::av21_envelope()};
};

TEST(LapRoad, HasTheSpeedLimitOfThePitLane) {
  const Stadium course;
  const Raceline pit = along(course.map, Region::kPitLane);
  const auto road = road_of(pit, course.lanes);
  ASSERT_EQ(road.size(), pit.points.size());
  const auto limited = [&](double station_m) {
    return road[static_cast<std::size_t>(station_m)].cap_mps;
  };
  // The lane goes from 60 m before the start to 480 m behind it.
  EXPECT_EQ(limited(0.0), 20.0);
  EXPECT_EQ(limited(470.0), 20.0);
  EXPECT_EQ(limited(490.0), envelope::kNoCap_mps);
  EXPECT_EQ(limited(course.map.length_m() - 70.0), envelope::kNoCap_mps);
  EXPECT_EQ(limited(course.map.length_m() - 50.0), 20.0);
  for (const RoadStep& step : road_of(along(course.map, Region::kTrack), course.lanes))
    EXPECT_EQ(step.cap_mps, envelope::kNoCap_mps);
}

TEST(LapRoad, GivesEachLineALapThatPassesItsCheck) {
  const Stadium course;
  RacelineBank bank{
      "stadium", "", {along(course.map, Region::kPitLane), along(course.map, Region::kTrack)}, 1.0};
  const auto problem = add_laps(bank, course.lanes, course.table);
  ASSERT_FALSE(problem) << to_string(*problem);
  for (const Raceline& line : bank.lines)
    EXPECT_TRUE(check_lap(line, road_of(line, course.lanes), course.table));
  EXPECT_GT(bank.lines[0].lap_s, bank.lines[1].lap_s + 10.0);
}

TEST(LapRoad, KeepsALapThatThereIs) {
  const Stadium course;
  RacelineBank bank{"stadium", "", {along(course.map, Region::kTrack)}, 1.0};
  bank.lines[0].lap.resize(bank.lines[0].points.size());
  bank.lines[0].lap_s = 12.0;
  EXPECT_FALSE(add_laps(bank, course.lanes, course.table));
  EXPECT_EQ(bank.lines[0].lap_s, 12.0);
}

TEST(LapRoad, TellsWhereALineCannotBeDriven) {
  const Stadium course;
  RacelineBank bank{"stadium", "", {along(course.map, Region::kTrack)}, 1.0};
  bank.lines[0].points[700].curvature_per_m = 100.0;
  const auto problem = add_laps(bank, course.lanes, course.table);
  ASSERT_TRUE(problem);
  EXPECT_NE(to_string(*problem).find("line: s = 700.2 m: error: no speed carries the car there: "
                                     "curvature 100.00000 1/m"),
            std::string::npos)
      << to_string(*problem);
}

}  // namespace
}  // namespace pitwall::raceline
