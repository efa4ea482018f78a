// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/timeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/vehicle/autonomy/localization/drive.hpp"

namespace pitwall::localization {
namespace {

const TimelineParams kParams = testing::recommended().timeline;

Belief first_belief() {
  Belief b;
  b.mean = {0.0, 0.0, 0.1, 30.0, 0.0, 0.0};
  for (std::size_t i = 0; i < kStates; ++i) b.covariance[i * kStates + i] = 0.04;
  return b;
}

// 0.2 s of all kinds of measurements, in order of time.
std::vector<Measurement> measurements() {
  testing::Random random;
  std::vector<Measurement> all;
  for (int i = 1; i <= 40; ++i) {
    Measurement m;
    m.at = Instant{} + milliseconds(5 * i);
    m.kind = i % 2 == 0 ? Kind::kImu : static_cast<Kind>(static_cast<int>(Kind::kPosition) + i % 4);
    m.unit = static_cast<std::uint8_t>(i % 2);
    m.motion = {0.1 + 0.01 * random.normal(), random.normal(), 3.0 + random.normal(), 0.2};
    const double t = 0.005 * i;
    m.a = m.kind == Kind::kHeading ? 0.1 : 30.0 * (m.kind == Kind::kPosition ? t : 1.0);
    m.b = 3.0 * (m.kind == Kind::kPosition ? t : 1.0);
    m.a += 0.02 * random.normal(), m.b += 0.02 * random.normal();
    m.sigma_a = m.sigma_b = 0.1;
    all.push_back(m);
  }
  return all;
}

Timeline play(const std::vector<Measurement>& all) {
  Timeline t;
  start(t, first_belief());
  for (const Measurement& m : all) EXPECT_TRUE(insert(t, kParams, m));
  return t;
}

TEST(Timeline, EveryOrderOfArrivalGivesTheSameBelief) {
  const std::vector<Measurement> in_order = measurements();
  const Timeline expected = play(in_order);
  testing::Random random;
  for (int round = 0; round < 50; ++round) {
    std::vector<Measurement> shuffled = in_order;
    for (std::size_t i = shuffled.size(); i > 1; --i) {
      std::swap(shuffled[i - 1],
                shuffled[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
    }
    const Timeline t = play(shuffled);
    EXPECT_EQ(t.newest().mean, expected.newest().mean) << round;  // to the last bit
    EXPECT_EQ(t.newest().covariance, expected.newest().covariance) << round;
  }
}

TEST(Timeline, AMeasurementAtTheSameInstantIsOrderedByItsKind) {
  Measurement wheel, heading;
  wheel.kind = Kind::kWheelSpeed, heading.kind = Kind::kHeading;
  wheel.at = heading.at = Instant{} + milliseconds(10);
  wheel.a = 30.2, wheel.sigma_a = 0.1, heading.a = 0.12, heading.sigma_a = 0.01;
  const Timeline a = play({wheel, heading}), b = play({heading, wheel});
  EXPECT_EQ(a.newest().mean, b.newest().mean);
  EXPECT_EQ(a.newest().covariance, b.newest().covariance);
}

TEST(Timeline, RefusesWhatIsOlderThanItRemembers) {
  Timeline t;
  start(t, first_belief());
  Measurement m;
  m.kind = Kind::kWheelSpeed;
  m.a = 30.0, m.sigma_a = 0.1;
  m.at = Instant{} - milliseconds(1);
  EXPECT_FALSE(insert(t, kParams, m));
  for (int i = 1; i <= 100; ++i) {
    m.at = Instant{} + milliseconds(10 * i);
    EXPECT_TRUE(insert(t, kParams, m));
  }
  const Belief before = t.newest();
  m.at = Instant{} + milliseconds(1000 - 240);
  EXPECT_TRUE(insert(t, kParams, m));
  m.at = Instant{} + milliseconds(1000 - 300);
  EXPECT_FALSE(insert(t, kParams, m));
  EXPECT_EQ(t.newest().at, before.at);
}

TEST(Timeline, ANearlyEndlessStreamNeverOverflows) {
  Timeline t;
  start(t, first_belief());
  Measurement m;
  m.kind = Kind::kWheelSpeed;
  m.a = 30.0, m.sigma_a = 0.1;
  for (int i = 1; i <= 5000; ++i) {
    m.at = Instant{} + microseconds(200 * i);  // 5 kHz: more than fits in the window
    EXPECT_TRUE(insert(t, kParams, m));
    ASSERT_LE(t.size, kTimelineEntries);
  }
  EXPECT_NEAR(t.newest().mean[kVx], 30.0, 0.1);
}

}  // namespace
}  // namespace pitwall::localization
