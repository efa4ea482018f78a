// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/derive.hpp"

#include <gtest/gtest.h>

#include "tests/basestation/known_state.hpp"

namespace pitwall::state {
namespace {

using telemetry::field;

struct DeriveRig {
  KnownState reported;
  Known known;
  MonitorState monitors;
  BaseViews views{};

  const FieldView& of(BaseField which, Instant now) {
    monitors.step(reported.vehicle, known, now);
    derive({}, reported.vehicle, known, monitors, nullptr, now, views);
    return views[index_of(which)];
  }
  void tyres(double fl, double fr, double rl, double rr) {
    reported.publish(field("tyres.temperature_front_left"), fl, kStart);
    reported.publish(field("tyres.temperature_front_right"), fr, kStart);
    reported.publish(field("tyres.temperature_rear_left"), rl, kStart);
    reported.publish(field("tyres.temperature_rear_right"), rr, kStart);
  }
  void receiver(bool second, double status, double sigma, double verdict) {
    const auto publish = [&](telemetry::FieldIndex first, telemetry::FieldIndex other,
                             double value) {
      reported.publish(second ? other : first, value, kStart);
    };
    publish(field("gnss0.status"), field("gnss1.status"), status);
    publish(field("gnss0.sigma"), field("gnss1.sigma"), sigma);
    publish(field("gnss0.position_verdict"), field("gnss1.position_verdict"), verdict);
    publish(field("gnss0.position_age"), field("gnss1.position_age"), 0.04);
  }
};

TEST(Derive, OfNothingIsNothing) {
  DeriveRig rig;
  rig.of(BaseField::kSlip, kStart);
  for (const BaseRow& row : kBaseTable) {
    const FieldView& view = rig.views[index_of(row.field)];
    const bool own = row.group == "base" || row.field == BaseField::kLinkState ||
                     row.field == BaseField::kCorrectionConflict ||
                     row.field == BaseField::kFuelPerLap || row.field == BaseField::kFuelState;
    EXPECT_TRUE(own || view.quality == Quality::kNever) << row.name;
  }
}

TEST(Derive, TheColdestTyreCountsAndAllMustBeKnown) {
  DeriveRig rig;
  rig.reported.publish(field("tyres.temperature_front_left"), 80, kStart);
  EXPECT_EQ(rig.of(BaseField::kTyreMin, kStart).quality, Quality::kNever);
  rig.tyres(80, 70, 29, 75);
  EXPECT_EQ(rig.of(BaseField::kTyreMin, kStart).value, 29.0);
  rig.reported.publish(field("track.target_speed"), from_mph(140), kStart);
  EXPECT_NEAR(rig.of(BaseField::kTyreMargin, kStart).value, 29.0 - 79.0, 1e-9);
}

TEST(Derive, AnOldInputMakesAnOldValue) {
  DeriveRig rig;
  rig.tyres(80, 80, 80, 80);
  const Instant later = kStart + seconds(5);
  rig.reported.publish(field("track.target_speed"), 40.0, later);
  const FieldView& margin = rig.of(BaseField::kTyreMargin, later);
  EXPECT_EQ(margin.quality, Quality::kStale);
  EXPECT_EQ(margin.age, seconds(5));
}

TEST(Derive, AttacksSayWhichEndSeesThem) {
  DeriveRig rig;
  const auto seen = [&](Instant now) { return rig.of(BaseField::kReplayedOpenings, now); };
  rig.known.link.threats = 0.0;  // a base that no car was heard at
  EXPECT_EQ(seen(kStart).value, 0.0);
  rig.known.link.threats = 16.0;
  EXPECT_EQ(seen(kStart).value, 1.0);
  EXPECT_EQ(rig.views[index_of(BaseField::kRelay)].value, 0.0);
  rig.reported.publish(field("radio.threats"), 48.0, kStart);
  EXPECT_EQ(seen(kStart).value, 3.0);
  EXPECT_EQ(rig.views[index_of(BaseField::kRelay)].value, 2.0);
  rig.known.link.threats = 0.0;
  EXPECT_EQ(seen(kStart).value, 2.0);
  // A car that is not heard any more says nothing of now.
  EXPECT_EQ(seen(kStart + seconds(10)).value, 0.0);
  EXPECT_EQ(seen(kStart + seconds(10)).quality, Quality::kFresh);
}

TEST(Derive, ReceiversSideBySide) {
  DeriveRig rig;
  rig.receiver(false, 0, 0.02, 1);
  EXPECT_EQ(rig.of(BaseField::kGnssGood, kStart).value, 1.0);  // a car with one
  rig.receiver(true, 0, 0.02, 10);                             // stands by
  EXPECT_EQ(rig.of(BaseField::kGnssGood, kStart).value, 2.0);
  rig.receiver(true, 0, 3.0, 1);
  EXPECT_EQ(rig.of(BaseField::kGnssGood, kStart).value, 1.0);
  rig.receiver(true, 0, 0.02, 8);  // jumped
  EXPECT_EQ(rig.of(BaseField::kGnssGood, kStart).value, 1.0);
  rig.receiver(false, 1, 0.02, 4);
  EXPECT_EQ(rig.of(BaseField::kGnssGood, kStart).value, 0.0);
}

TEST(Derive, StopIsTheHigherOfModeAndLatch) {
  DeriveRig rig;
  for (double latch = 0; latch <= 2; ++latch) {
    for (double mode = 0; mode <= 6; ++mode) {
      rig.reported.publish(field("mode.stop_latch"), latch, kStart);
      rig.reported.publish(field("mode.mode"), mode, kStart);
      const double by_mode = mode == 4 ? 2 : mode == 3 ? 1 : 0;
      EXPECT_EQ(rig.of(BaseField::kStop, kStart).value, std::max(latch, by_mode));
    }
  }
}

TEST(Derive, WatchdogsAreCountedByTheirState) {
  DeriveRig rig;
  rig.reported.publish(field("streams.imu0"), 2, kStart);
  rig.reported.publish(field("streams.imu1"), 3, kStart);
  rig.reported.publish(field("streams.brake"), 4, kStart);
  rig.reported.publish(field("streams.radio"), 4, kStart);
  EXPECT_EQ(rig.of(BaseField::kWatchdogsLate, kStart).value, 1.0);
  EXPECT_EQ(rig.of(BaseField::kWatchdogsLost, kStart).value, 2.0);
}

TEST(Derive, GroupsThatGrowOldAreCountedButNoOpponents) {
  DeriveRig rig;
  rig.reported.publish(field("ego.x"), 1, kStart);
  rig.reported.publish(field("opponent_1.speed"), 1, kStart);
  rig.reported.publish(field("mode.mode"), 2, kStart + seconds(9));
  EXPECT_EQ(rig.of(BaseField::kStaleGroups, kStart + seconds(9)).value, 1.0);
}

}  // namespace
}  // namespace pitwall::state
