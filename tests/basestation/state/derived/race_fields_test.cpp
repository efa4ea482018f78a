// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/race_fields.hpp"

#include <gtest/gtest.h>

#include "tests/basestation/known_state.hpp"

namespace pitwall::state {
namespace {

using telemetry::field;

struct RaceRig {
  KnownState reported;
  Known known;
  MonitorState monitors;
  BaseViews views{};

  const FieldView& of(BaseField which, Instant now, const Course* course = nullptr) {
    const Pass pass{.vehicle = reported.vehicle, .now = now, .views = views};
    derive_race(pass, known, monitors, {}, course);
    return views[index_of(which)];
  }
};

Course oval() {
  std::vector<CoursePoint> points;
  for (int i = 0; i < 24; ++i)
    points.push_back({.s_m = i * 100.0, .x_m = 0, .y_m = 0, .yaw_rad = 0, .curvature_per_m = 0});
  return *Course::make(std::move(points), 2'400.0);
}

TEST(RaceFields, GapsAreToOpponentsThatAreKnownNow) {
  RaceRig rig;
  const Course course = oval();
  const auto gap = [&](BaseField which, Instant now) { return rig.of(which, now, &course); };
  EXPECT_EQ(gap(BaseField::kGapAhead, kStart).quality, Quality::kNever);
  rig.reported.publish(field("track.station"), 2'380.0, kStart);
  rig.reported.publish(field("ego.vx"), 60.0, kStart);
  rig.reported.publish(field("opponent_1.station"), 20.0, kStart);
  rig.reported.publish(field("opponent_1.speed"), 50.0, kStart);
  EXPECT_NEAR(gap(BaseField::kGapAhead, kStart).value, 35.1, 0.05);
  EXPECT_EQ(gap(BaseField::kGapBehind, kStart).quality, Quality::kNever);
  EXPECT_EQ(gap(BaseField::kGapClosing, kStart).value, 10.0);
  // Seen no more: what was last known, struck out. Another one that is seen counts instead.
  const Instant later = kStart + seconds(5);
  rig.reported.touch(telemetry::Group::kTrack, later);
  EXPECT_EQ(gap(BaseField::kGapAhead, later).quality, Quality::kStale);
  rig.reported.publish(field("opponent_2.station"), 300.0, later);
  EXPECT_NEAR(gap(BaseField::kGapAhead, later).value, 315.1, 0.05);
  EXPECT_EQ(gap(BaseField::kGapAhead, later).quality, Quality::kFresh);
}

TEST(RaceFields, ARoleThatTheCarDoesNotActOnIsAConflict) {
  RaceRig rig;
  constexpr double kAttackerFlag = 10, kDefends = 1, kAttacks = 2;
  rig.reported.publish(field("flags.vehicle"), kAttackerFlag, kStart);
  EXPECT_EQ(rig.of(BaseField::kRole, kStart).value, kAttacks);
  EXPECT_EQ(rig.of(BaseField::kRoleConflict, kStart).quality, Quality::kNever);
  rig.reported.publish(field("planner.role"), kDefends, kStart);
  EXPECT_EQ(rig.of(BaseField::kRoleConflict, kStart).value, 1.0);
  rig.reported.publish(field("planner.role"), kAttacks, kStart);
  EXPECT_EQ(rig.of(BaseField::kRoleConflict, kStart).value, 0.0);
}

TEST(RaceFields, TheAttemptGrowsOldWithTheFlagsItIsCountedBy) {
  RaceRig rig;
  rig.reported.publish(field("flags.track"), 5.0, kStart);
  rig.reported.publish(field("flags.vehicle"), 10.0, kStart);
  rig.reported.publish(field("track.lap"), 4.0, kStart);
  rig.monitors.step_race(rig.reported.vehicle, {}, nullptr, kStart);
  EXPECT_EQ(rig.of(BaseField::kAttempt, kStart).value, 1.0);
  EXPECT_EQ(rig.of(BaseField::kAttemptLapsLeft, kStart).value, 2.0);
  EXPECT_EQ(rig.of(BaseField::kAttempt, kStart + seconds(5)).quality, Quality::kStale);
}

}  // namespace
}  // namespace pitwall::state
