// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/metrics/metrics_outlet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/basestation/radio_rig.hpp"

namespace pitwall::outlets::metrics {
namespace {

using telemetry::field;

class Counting : public Outlet {
 public:
  void packet(const intake::Station&, const telemetry::Arrival&) override {}
  void serve(intake::Station&, Instant) override {}
  Instant due() const override { return {}; }
  std::optional<OutletFigures> figures() const override {
    return OutletFigures{.outlet = "lcm", .sent = 5};
  }
};

TEST(MetricsOutlet, AStandIsSeenAsItIsNow) {
  RadioRig rig;
  rig.set(field("ego.vx"), 50.5);
  rig.run(seconds(2));
  const Counting other{};
  const CarSight sight =
      sight_of(*rig.station, {.car = 7, .name = "Seven", .outlets = {&other}}, rig.now);
  EXPECT_EQ(sight.mode, "REAL");
  EXPECT_NEAR(sight.numbers[field("ego.vx")], 50.5, 0.05);
  EXPECT_TRUE(std::isnan(sight.numbers[field("ego.y")])) << "the car does not know it";
  EXPECT_TRUE(std::isnan(sight.numbers[telemetry::kFieldCount]))
      << "without a wall, no field of it";
  EXPECT_LT(sight.ages_s[telemetry::index_of(telemetry::Group::kEgo)], 0.2);
  EXPECT_TRUE(std::isnan(sight.ages_s[telemetry::index_of(telemetry::Group::kTyres)]));
  EXPECT_GT(sight.counts.at(0).value, 50U) << "packets";
  ASSERT_EQ(sight.outlets.size(), 1U);
  EXPECT_EQ(sight.outlets[0].sent, 5U);
}

TEST(MetricsOutlet, AStaleFieldIsNotToldAsAPresentOne) {
  RadioRig rig;
  rig.set(field("ego.vx"), 50.5);
  rig.run(seconds(2));
  const CarSight later = sight_of(*rig.station, {.car = 7, .name = ""}, rig.now + seconds(10));
  EXPECT_TRUE(std::isnan(later.numbers[field("ego.vx")]));
  EXPECT_GT(later.ages_s[telemetry::index_of(telemetry::Group::kEgo)], 9.0);
}

TEST(MetricsOutlet, ItLooksOnceASecond) {
  RadioRig rig;
  rig.run(seconds(1));
  Board board;
  MetricsOutlet outlet{board, {.car = 7, .name = "first"}};
  outlet.serve(*rig.station, rig.now);
  const std::string first = board.text();
  EXPECT_NE(first.find("pitwall_car_info"), std::string::npos);
  rig.run(milliseconds(500));
  outlet.serve(*rig.station, rig.now);
  EXPECT_EQ(board.text(), first);
  EXPECT_EQ(outlet.due() - rig.now, milliseconds(500));
  rig.run(milliseconds(500));
  outlet.serve(*rig.station, rig.now);
  EXPECT_NE(board.text(), first);
}

}  // namespace
}  // namespace pitwall::outlets::metrics
