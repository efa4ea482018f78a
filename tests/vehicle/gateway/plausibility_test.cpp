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
    ASSERT_EQ(slew_row(limit.id, limit.signal), row);
    const Duration period = period_of(limit.id);
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
  const double one_period = limit.max_per_s * period_of(limit.id).seconds();
  EXPECT_FALSE(too_fast(c, {0, one_period}));
  EXPECT_TRUE(too_fast(c, {0, one_period * 1.001}));
  EXPECT_FALSE(too_fast(c, {kNoLimit, 1e9}));
}

}  // namespace
}  // namespace pitwall::gateway
