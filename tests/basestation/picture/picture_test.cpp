// SPDX-License-Identifier: Apache-2.0
#include "basestation/picture/picture.hpp"

#include <gtest/gtest.h>

namespace pitwall::picture {
namespace {

using telemetry::field;
using telemetry::Group;

telemetry::StatePacket with_x(double x_m, Duration age) {
  telemetry::StatePacket packet;
  packet.values[field("ego.x")] = x_m;
  packet.age_of(Group::kEgo) = age;
  return packet;
}

TEST(Picture, NothingWasEverHeard) {
  const Picture picture;
  EXPECT_FALSE(picture.ever());
  for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i) {
    EXPECT_EQ(picture.view(i, {seconds(5).ns}).quality, Quality::kNever);
  }
}

TEST(Picture, AgeIsTheSamplesAgePlusTheTimeSinceReception) {
  Picture picture;
  picture.update(with_x(12.0, milliseconds(30)), {seconds(1).ns});
  const FieldView view = picture.view(field("ego.x"), Instant{seconds(1).ns} + milliseconds(50));
  EXPECT_EQ(view.value, 12.0);
  EXPECT_EQ(view.age, milliseconds(80));
}

TEST(Picture, QualityFollowsTheTargetAgeOfTheField) {
  Picture picture;
  picture.update(with_x(1.0, {}), {});
  const Duration target = telemetry::kFields[field("ego.x")].target_age();
  const auto quality = [&](Duration t) { return picture.view(field("ego.x"), {t.ns}).quality; };
  EXPECT_EQ(quality(target), Quality::kFresh);
  EXPECT_EQ(quality(target + nanoseconds(1)), Quality::kLate);
  EXPECT_EQ(quality(target * kLateFactor), Quality::kLate);
  EXPECT_EQ(quality(target * kLateFactor + nanoseconds(1)), Quality::kStale);
}

TEST(Picture, AFieldThatTheCarNoLongerKnowsGrowsOldInsteadOfVanishingOrLookingFresh) {
  Picture picture;
  picture.update(with_x(3.0, {}), {});
  picture.update(with_x(kUnset, {}), {seconds(1).ns});
  const FieldView view = picture.view(field("ego.x"), {seconds(1).ns});
  EXPECT_EQ(view.value, 3.0);
  EXPECT_EQ(view.age, seconds(1));
  EXPECT_EQ(view.quality, Quality::kStale);
}

TEST(Picture, AGroupThatWasNeverSampledIsNotBelieved) {
  Picture picture;
  picture.update(with_x(3.0, microseconds(-1)), {});
  EXPECT_EQ(picture.view(field("ego.x"), {}).quality, Quality::kNever);
}

TEST(Picture, KnowsWhoSent) {
  Picture picture;
  telemetry::StatePacket packet;
  packet.source = telemetry::Source::kCar;
  picture.update(packet, {});
  EXPECT_EQ(picture.source(), telemetry::Source::kCar);
  packet.source = telemetry::Source::kSimulation;
  picture.update(packet, {});
  EXPECT_EQ(picture.source(), telemetry::Source::kSimulation);
}

TEST(Picture, QualitiesHaveNames) {
  EXPECT_STREQ(text_of(Quality::kFresh), "fresh");
  EXPECT_STREQ(text_of(Quality::kLate), "late");
  EXPECT_STREQ(text_of(Quality::kStale), "stale");
  EXPECT_STREQ(text_of(Quality::kNever), "never");
}

}  // namespace
}  // namespace pitwall::picture
