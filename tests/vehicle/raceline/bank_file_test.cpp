// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/bank_file.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/support/replaced.hpp"
#include "tests/vehicle/raceline/courses.hpp"
#include "vehicle/raceline/bank_builder.hpp"

namespace pitwall::raceline {
namespace {

struct Course {
  world::TrackDescription description = stadium();
  world::TrackMap map = valid(world::TrackMap::build(description));
  RacelineBank bank = valid(build_bank(description, map, {.car_width_m = 2.0}));

  std::string refusal_of(const std::string& text) const {
    const auto bank_read = read_bank(text, "bank.json", description, map, car_limits());
    return bank_read ? "" : to_string(bank_read.error());
  }
  std::string refusal_of(const std::function<void(RacelineBank&)>& change) const {
    RacelineBank changed = bank;
    change(changed);
    return refusal_of(to_json(changed));
  }
};

void expect_refusal(const std::string& refusal, const std::string& part) {
  EXPECT_EQ(refusal.substr(0, 9), "bank.json") << refusal;
  EXPECT_NE(refusal.find(part), std::string::npos) << refusal;
}

TEST(BankFile, ReadsBackWhatWasWritten) {
  const Course course;
  const RacelineBank read = valid(
      read_bank(to_json(course.bank), "bank.json", course.description, course.map, car_limits()));
  EXPECT_EQ(read.track, "stadium");
  EXPECT_EQ(read.track_fingerprint, course.bank.track_fingerprint);
  ASSERT_EQ(read.lines.size(), course.bank.lines.size());
  for (std::size_t i = 0; i < read.lines.size(); ++i) {
    const Raceline &a = course.bank.lines[i], &b = read.lines[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.region, b.region);
    EXPECT_NEAR(a.length_m, b.length_m, 1e-7);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t k = 0; k < a.points.size(); ++k) {
      EXPECT_NEAR(a.points[k].x_m, b.points[k].x_m, 1e-7);
      EXPECT_NEAR(a.points[k].y_m, b.points[k].y_m, 1e-7);
      EXPECT_NEAR(a.points[k].yaw_rad, b.points[k].yaw_rad, 1e-9);
      EXPECT_NEAR(a.points[k].curvature_per_m, b.points[k].curvature_per_m, 1e-9);
      EXPECT_NEAR(a.points[k].bank_rad, b.points[k].bank_rad, 1e-9);
    }
  }
}

// With speed profiles: of one speed, since the file does not judge them without an envelope.
TEST(BankFile, ReadsSpeedProfilesBack) {
  const Course course;
  RacelineBank bank = course.bank;
  bank.tyre_share = 0.75;
  Raceline& line = bank.lines[1];
  for (std::size_t i = 0; i < line.points.size(); ++i)
    line.lap.push_back({.speed_mps = 40.0 + 0.001 * static_cast<double>(i),
                        .accel_mps2 = -0.25,
                        .time_s = 0.025 * static_cast<double>(i),
                        .gear = static_cast<std::uint8_t>(1 + i % 6)});
  line.lap_s = 61.25;
  const RacelineBank read =
      valid(read_bank(to_json(bank), "bank.json", course.description, course.map, car_limits()));
  EXPECT_EQ(read.tyre_share, 0.75);
  EXPECT_TRUE(read.lines[0].lap.empty());
  EXPECT_EQ(read.lines[1].lap_s, 61.25);
  ASSERT_EQ(read.lines[1].lap.size(), line.lap.size());
  for (std::size_t i = 0; i < line.lap.size(); ++i) {
    EXPECT_NEAR(read.lines[1].lap[i].speed_mps, line.lap[i].speed_mps, 1e-6);
    EXPECT_NEAR(read.lines[1].lap[i].accel_mps2, line.lap[i].accel_mps2, 1e-6);
    EXPECT_NEAR(read.lines[1].lap[i].time_s, line.lap[i].time_s, 1e-6);
    EXPECT_EQ(read.lines[1].lap[i].gear, line.lap[i].gear);
  }
  const std::string text = to_json(bank);
  expect_refusal(course.refusal_of(testing::replaced(text, "\"lap_s\": 61.250000, ", "")),
                 "inner/centre: error: point 1 has 9 numbers, expected 5");
  bank.lines[1].lap[9].time_s = kUnset;
  expect_refusal(course.refusal_of(testing::replaced(to_json(bank), "nan", "null")),
                 "inner/centre: s = 9.0 m: error: a value is missing or not a number");
  expect_refusal(
      course.refusal_of(testing::replaced(text, "\"tyre_share\": 0.75", "\"tyre_share\": 1.75")),
      "tyre_share is 1.75, allowed 0.05 to 1");
}

TEST(BankFile, RefusesABankOfAnotherTrack) {
  const Course course;
  const world::TrackDescription other = ring();
  const world::TrackMap map = valid(world::TrackMap::build(other));
  const auto refused = read_bank(to_json(course.bank), "bank.json", other, map, car_limits());
  ASSERT_FALSE(refused);
  expect_refusal(to_string(refused.error()), "is of track stadium (fingerprint " +
                                                 course.bank.track_fingerprint.substr(0, 12) +
                                                 "), expected ring (");
}

// A wall that was moved by a centimetre.
TEST(BankFile, RefusesABankOfAnotherRevision) {
  const Course course;
  world::TrackDescription revised = course.description;
  revised.knots[5].width_right_m += 0.01;
  const world::TrackMap map = valid(world::TrackMap::build(revised));
  const auto refused = read_bank(to_json(course.bank), "bank.json", revised, map, car_limits());
  ASSERT_FALSE(refused);
  expect_refusal(to_string(refused.error()), "is of another revision of track stadium");
}

TEST(BankFile, RefusesWhatIsNoBank) {
  const Course course;
  const std::string text = to_json(course.bank);
  expect_refusal(course.refusal_of(text.substr(0, text.size() / 2)), "");
  expect_refusal(course.refusal_of("{}"), "is not a bank of racelines");
  expect_refusal(course.refusal_of(testing::replaced(text, "\"version\": 2", "\"version\": 1")),
                 "is of version 1, expected 2");
  expect_refusal(
      course.refusal_of(testing::replaced(text, "\"region\": \"inner\"", "\"region\": \"apron\"")),
      "inner/inside: error: the region is \"apron\"");
  expect_refusal(
      course.refusal_of(testing::replaced(text, "\"name\": \"inner/inside\"", "\"name\": \"\"")),
      "a line without a name");
  expect_refusal(course.refusal_of(testing::replaced(text, "    [", "    [1.0, ")),
                 "inner/inside: error: point 1 has 6 numbers, expected 5");
  expect_refusal(course.refusal_of([](RacelineBank& b) { b.lines.clear(); }), "has no line");
  expect_refusal(course.refusal_of([](RacelineBank& b) { b.lines[1].name = "inner/inside"; }),
                 "inner/inside: error: two lines of this name");
}

TEST(BankFile, RefusesLinesThatTheCheckRefuses) {
  const Course course;
  expect_refusal(course.refusal_of([](RacelineBank& b) { b.lines[1].region = Region::kOuterLane; }),
                 "inner/centre: s = 0.0 m: error: leaves the outer lane");
  expect_refusal(
      course.refusal_of([](RacelineBank& b) { b.lines[2].points[700].curvature_per_m += 0.01; }),
      "inner/outside: s = 69");
  std::string text = to_json(course.bank);
  const std::size_t first = text.find("    [") + 5;
  expect_refusal(course.refusal_of(text.replace(first, text.find(',', first) - first, "null")),
                 "inner/inside: s = 0.0 m: error: a value is missing or not a number");
  world::TrackDescription closed = course.description;
  closed.pit.reset();
  const world::TrackMap map = valid(world::TrackMap::build(closed));
  RacelineBank bank = valid(build_bank(closed, map, {.car_width_m = 2.0}));
  bank.lines[0].region = Region::kPitLane;
  const auto refused = read_bank(to_json(bank), "bank.json", closed, map, car_limits());
  ASSERT_FALSE(refused);
  expect_refusal(to_string(refused.error()), "a line through a pit lane that the track lacks");
}

}  // namespace
}  // namespace pitwall::raceline
