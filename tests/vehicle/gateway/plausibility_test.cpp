// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/plausibility.hpp"

#include <gtest/gtest.h>

namespace pitwall::gateway {
namespace {

TEST(Plausibility, RangesIncludeTheirEndsAndNothingElse) {
  const Span span{-2.0, 3.0};
  const auto judge = [&](double v) { return in_range(std::array<Ranged, 1>{{{v, span}}}); };
  EXPECT_EQ(judge(-2.0), Reading::kApplied);
  EXPECT_EQ(judge(3.0), Reading::kApplied);
  EXPECT_EQ(judge(std::nextafter(-2.0, -9.0)), Reading::kOutOfRange);
  EXPECT_EQ(judge(std::nextafter(3.0, 9.0)), Reading::kOutOfRange);
  EXPECT_EQ(judge(kUnset), Reading::kNotFinite);
  EXPECT_EQ(judge(HUGE_VAL), Reading::kNotFinite);
}

TEST(Plausibility, EverySlewIsJudgedAtItsLimitInTheTimeThatPassed) {
  const InboundParams params;
  for (std::size_t row = 0; row < can::av21::kSlews.size(); ++row) {
    const can::SlewRow& limit = can::av21::kSlews[row];
    const Duration period = kSlewPeriods[row];
    ASSERT_GT(period, Duration{});
    for (const std::int64_t periods : {1, 2, 7}) {
      const double allowed = limit.max_per_s * (period * periods).seconds();
      for (const double sign : {-1.0, 1.0}) {
        for (const bool over : {false, true}) {
          InboundState state;
          Context c{params, state, Instant{} + seconds(1)};
          ASSERT_EQ(settle(c, std::array<Change, 1>{{{row, 10.0}}}), Reading::kApplied);
          c.at += period * periods;
          const double change = sign * allowed * (over ? 1.0001 : 0.9999);
          EXPECT_EQ(settle(c, std::array<Change, 1>{{{row, 10.0 + change}}}),
                    over ? Reading::kImplausibleSlew : Reading::kApplied)
              << limit.signal;
          EXPECT_DOUBLE_EQ(state.slews[row].value, over ? 10.0 : 10.0 + change);
        }
      }
    }
  }
}

TEST(Plausibility, RowsAreFoundByMessageAndSignal) {
  constexpr std::size_t kRow =
      slew_row(can::av21::SteeringReport::kId, "steering_motor_ang_avg_fdbk");
  ASSERT_LT(kRow, kNoLimit);
  EXPECT_EQ(can::av21::kSlews[kRow].id, can::av21::SteeringReport::kId);
  EXPECT_EQ(kSlewPeriods[kRow], milliseconds(10));
  static_assert(slew_row(can::av21::SteeringReport::kId, "wheel_speed_FL") == kNoLimit);
}

TEST(Plausibility, OneImplausibleSignalRefusesTheWholeFrame) {
  const InboundParams params;
  InboundState state;
  Context c{params, state, Instant{}};
  ASSERT_GE(can::av21::kSlews.size(), 2u);
  ASSERT_EQ(settle(c, std::array<Change, 2>{{{0, 0.0}, {1, 0.0}}}), Reading::kApplied);
  EXPECT_EQ(settle(c, std::array<Change, 2>{{{0, 1e-3}, {1, 1e9}}}), Reading::kImplausibleSlew);
  EXPECT_EQ(state.slews[0].value, 0.0);
}

TEST(Plausibility, FramesThatArriveTogetherAreAllowedOnePeriod) {
  const InboundParams params;
  const can::SlewRow& limit = can::av21::kSlews[0];
  InboundState state;
  Context c{params, state, Instant{}};
  ASSERT_EQ(settle(c, std::array<Change, 1>{{{0, 0.0}}}), Reading::kApplied);
  const double one_period = limit.max_per_s * kSlewPeriods[0].seconds();
  EXPECT_FALSE(too_fast(c, {0, one_period}));
  EXPECT_TRUE(too_fast(c, {0, one_period * 1.001}));
  EXPECT_FALSE(too_fast(c, {kNoLimit, 1e9}));
}

}  // namespace
}  // namespace pitwall::gateway
