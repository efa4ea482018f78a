// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/metrics/metrics_publisher.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/basestation/radio_rig.hpp"

namespace pitwall::publishers::metrics {
namespace {

using telemetry::field;

class Counting : public service::Publisher {
 public:
  void publish(const service::CarService&, Instant) override {}
  Instant due() const override { return {}; }
  std::optional<service::PublisherFigures> figures() const override {
    return service::PublisherFigures{.publisher = "lcm", .sent = 5};
  }
};

TEST(MetricsPublisher, ACarIsShownAsItIsNow) {
  RadioRig rig{{.service = {.car = 7, .name = "Seven"}}};
  rig.set(field("ego.vx"), 50.5);
  rig.run(seconds(2));
  const Counting other{};
  const CarStatus status = status_of(*rig.base, {.publishers = {&other}}, rig.now);
  EXPECT_EQ(status.car, 7);
  EXPECT_EQ(status.name, "Seven");
  EXPECT_EQ(status.mode, "REAL");
  EXPECT_NEAR(status.numbers[field("ego.vx")], 50.5, 0.05);
  EXPECT_TRUE(std::isnan(status.numbers[field("ego.y")])) << "the car does not know it";
  EXPECT_EQ(status.numbers[telemetry::kFieldCount], 1.0) << "the link is good, without a console";
  EXPECT_LT(status.ages_s[telemetry::index_of(telemetry::Group::kEgo)], 0.2);
  EXPECT_TRUE(std::isnan(status.ages_s[telemetry::index_of(telemetry::Group::kTyres)]));
  EXPECT_GT(status.counts.at(0).value, 50U) << "packets";
  ASSERT_EQ(status.publishers.size(), 1U);
  EXPECT_EQ(status.publishers[0].sent, 5U);
}

TEST(MetricsPublisher, AStaleFieldIsNotToldAsAPresentOne) {
  RadioRig rig;
  rig.set(field("ego.vx"), 50.5);
  rig.run(seconds(2));
  const CarStatus later = status_of(*rig.base, {}, rig.now + seconds(10));
  EXPECT_TRUE(std::isnan(later.numbers[field("ego.vx")]));
  EXPECT_GT(later.ages_s[telemetry::index_of(telemetry::Group::kEgo)], 9.0);
}

TEST(MetricsPublisher, ItLooksOnceASecond) {
  RadioRig rig;
  rig.run(seconds(1));
  Board board;
  MetricsPublisher publisher{board, {}};
  publisher.publish(*rig.base, rig.now);
  const std::string first = board.text();
  EXPECT_NE(first.find("pitwall_car_info"), std::string::npos);
  rig.run(milliseconds(500));
  publisher.publish(*rig.base, rig.now);
  EXPECT_EQ(board.text(), first);
  EXPECT_EQ(publisher.due() - rig.now, milliseconds(500));
  rig.run(milliseconds(500));
  publisher.publish(*rig.base, rig.now);
  EXPECT_NE(board.text(), first);
}

}  // namespace
}  // namespace pitwall::publishers::metrics
