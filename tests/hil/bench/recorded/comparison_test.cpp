// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/comparison.hpp"

#include <gtest/gtest.h>

#include "protocol/can/av21.hpp"
#include "protocol/can/encode.hpp"
#include "tests/hil/bench/recorded/recorded_drive.hpp"

namespace pitwall::bench {
namespace {

can::Frame brake(double kpa, double counter) {
  can::Frame frame;
  can::EncodeCounters counters;
  EXPECT_TRUE(
      can::av21::encode(can::av21::BrakePressureReport{kpa, kpa, counter}, frame, counters));
  return frame;
}

struct Pair {
  RecordedTick recorded;
  AgainTick again;
};
Pair pair_of(std::uint64_t tick, std::vector<can::Frame> recorded, std::vector<can::Frame> again) {
  Pair pair;
  pair.recorded.given.number = tick;
  pair.recorded.now = Instant{seconds(1).ns} + milliseconds(10) * static_cast<std::int64_t>(tick);
  pair.recorded.sent = std::move(recorded);
  pair.again.sent = std::move(again);
  return pair;
}

TEST(Comparison, NamesTheSignalTheFirstAndTheLargestDifference) {
  Comparison comparison{own_database(), {}};
  for (std::uint64_t tick = 0; tick < 10; ++tick) {
    const double off = tick < 4 ? 0.0 : tick == 7 ? 50.0 : 10.0;
    const Pair pair = pair_of(tick, {brake(1'000, 1)}, {brake(1'000 + off, 1)});
    comparison.add(pair.recorded, pair.again, {});
  }
  const auto differences = comparison.differences();
  ASSERT_EQ(differences.size(), 2U) << "front and rear, and not the counter";
  const SignalDifference& front = differences[0];
  EXPECT_EQ(front.signal.substr(0, front.signal.find('.')), can::av21::BrakePressureReport::kName);
  EXPECT_EQ(front.values, 6U);
  EXPECT_EQ(front.first.tick, 4U);
  EXPECT_EQ(front.first.recorded, 1'000.0);
  EXPECT_EQ(front.first.again, 1'010.0);
  EXPECT_EQ(front.largest.tick, 7U);
  EXPECT_EQ(front.largest.size(), 50.0);
  EXPECT_EQ(comparison.frames(), 10U);
}

TEST(Comparison, AFrameThatOnlyOneSideSaysIsADifferenceOfItsMessage) {
  Comparison comparison{own_database(), {}};
  Pair pair = pair_of(0, {brake(1, 1), brake(2, 2)}, {brake(1, 1)});
  comparison.add(pair.recorded, pair.again, {});
  pair = pair_of(1, {}, {brake(1, 1)});
  comparison.add(pair.recorded, pair.again, {});
  const auto differences = comparison.differences();
  ASSERT_EQ(differences.size(), 1U);
  EXPECT_EQ(differences[0].signal, std::string{can::av21::BrakePressureReport::kName} + " (frame)");
  EXPECT_EQ(differences[0].values, 2U);
}

TEST(Comparison, BitsOfNoSignalAreADifferenceAndAnIgnoredMessageIsNone) {
  can::Frame spoilt = brake(1'000, 1);
  spoilt.data[1] ^= 0x80U;  // bit 15, between two signals
  const Pair pair = pair_of(0, {brake(1'000, 1), brake(2, 2)}, {spoilt});
  const std::string message{can::av21::BrakePressureReport::kName};
  Comparison comparison{own_database(), {}};
  comparison.add(pair.recorded, pair.again, {});
  ASSERT_EQ(comparison.differences().size(), 1U);
  EXPECT_EQ(comparison.differences()[0].signal, message + " (frame)");
  EXPECT_EQ(comparison.differences()[0].values, 2U) << "the bits, and the frame that is missing";
  Comparison ignored{own_database(), {.tolerance = {}, .ignored = {message}}};
  ignored.add(pair.recorded, pair.again, {});
  EXPECT_TRUE(ignored.differences().empty());
}

TEST(Comparison, ToleranceAndIgnoredSignalsAreNoDifferenceAndUnusedRulesAreTold) {
  const std::string message{can::av21::BrakePressureReport::kName};
  const Pair pair = pair_of(0, {brake(1'000, 1)}, {brake(1'010, 1)});
  Comparison ignored{own_database(), {.tolerance = {}, .ignored = {message}}};
  ignored.add(pair.recorded, pair.again, {});
  EXPECT_TRUE(ignored.differences().empty());
  EXPECT_TRUE(ignored.unused_rules().empty());

  Comparison plain{own_database(), {}};
  plain.add(pair.recorded, pair.again, {});
  const auto found = plain.differences();
  ASSERT_EQ(found.size(), 2U);
  CompareRules rules;
  for (const SignalDifference& d : found) rules.tolerance[d.signal] = 10.0;
  rules.tolerance["ego.nothing"] = 1.0;
  Comparison tolerant{own_database(), rules};
  tolerant.add(pair.recorded, pair.again, {});
  EXPECT_TRUE(tolerant.differences().empty());
  EXPECT_EQ(tolerant.unused_rules(), (std::vector<std::string>{"ego.nothing"}));
  rules.tolerance[found[0].signal] = 9.0;
  Comparison strict{own_database(), rules};
  strict.add(pair.recorded, pair.again, {});
  EXPECT_EQ(strict.differences().size(), 1U);
}

TEST(Comparison, FieldsAreComparedByTheirBitsAndMeasuredOnesAreNot) {
  Pair pair = pair_of(3, {}, {});
  pair.recorded.state.emplace();
  pair.recorded.state->groups.add(telemetry::Group::kEgo);
  pair.again.state.emplace();
  pair.again.state->groups.add(telemetry::Group::kEgo);
  pair.again.state->values[telemetry::field("ego.vx")] = 1.0;  // the other one is NaN
  pair.again.state->values[telemetry::field("ego.vy")] = 2.0;
  FieldSet measured;
  measured.set(telemetry::field("ego.vy"));
  Comparison comparison{own_database(), {}};
  comparison.add(pair.recorded, pair.again, measured);
  ASSERT_EQ(comparison.differences().size(), 1U);
  EXPECT_EQ(comparison.differences()[0].signal, "ego.vx");
  EXPECT_EQ(comparison.differences()[0].context.rfind("at station", 0), 0U);
}

TEST(Comparison, AGroupThatOnlyTheNewBuildTellsIsADifferenceUnlessTheRecordingLostIt) {
  Pair pair = pair_of(6, {}, {});
  pair.recorded.state.emplace();
  pair.again.state.emplace();
  pair.again.state->groups.add(telemetry::Group::kEgo);
  Comparison comparison{own_database(), {}};
  comparison.add(pair.recorded, pair.again, {});
  ASSERT_EQ(comparison.differences().size(), 1U);
  EXPECT_EQ(comparison.differences()[0].signal, "ego (group)");
  EXPECT_EQ(comparison.differences()[0].first.tick, 6U);
  Comparison ignored{own_database(), {.tolerance = {}, .ignored = {"ego"}}};
  ignored.add(pair.recorded, pair.again, {});
  EXPECT_TRUE(ignored.differences().empty());
  EXPECT_TRUE(ignored.unused_rules().empty());
  pair.recorded.state->groups.add(telemetry::Group::kEgo);
  comparison.add(pair.recorded, pair.again, {});
  EXPECT_TRUE(comparison.differences().empty()) << "it tells it elsewhere: that tick's was lost";
}

}  // namespace
}  // namespace pitwall::bench
