// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/age_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hil/sensors/noise.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::link {
namespace {

TEST(AgeSamples, AnEvenSenderIsBetweenItsDelayAndOnePeriodMore) {
  AgeSamples ages(at_ms(1'000), at_ms(11'000));
  for (std::int64_t made = 0; made < 11'000; made += 20)
    ages.arrived(at_ms(made), at_ms(made + 15));
  ages.finish();
  EXPECT_EQ(ages.looks(), 10'000U);
  EXPECT_EQ(ages.unknown(), 0U);
  EXPECT_EQ(ages.quantile_ms(0.0), 15.0);
  EXPECT_EQ(ages.quantile_ms(0.5), 24.0);
  EXPECT_EQ(ages.max_ms(), 34.0);
}

// Beside a look-by-look computation over arrivals in any order of age.
TEST(AgeSamples, IsWhatOneSeesWhoLooksEachMillisecond) {
  sensors::Noise random(3, 0);
  struct Arrival {
    Instant made{}, at{};
  };
  std::vector<Arrival> arrivals;
  Instant at = at_ms(50);
  for (int i = 0; i < 500; ++i) {
    at += microseconds(static_cast<std::int64_t>(random.uniform() * 30'000));
    arrivals.push_back(
        {at - microseconds(static_cast<std::int64_t>(random.uniform() * 90'000)), at});
  }
  AgeSamples ages(at_ms(0), at_ms(6'000));
  for (const Arrival& a : arrivals) ages.arrived(a.made, a.at);
  ages.finish();

  std::vector<double> seen;
  std::size_t unknown = 0;
  for (Instant look = at_ms(0); look < at_ms(6'000); look += kSamplePeriod) {
    Instant newest = at_ms(-1'000'000);
    for (const Arrival& a : arrivals)
      if (a.at <= look) newest = std::max(newest, a.made);
    if (newest == at_ms(-1'000'000)) {
      ++unknown;
    } else {
      seen.push_back((look - newest).milliseconds());
    }
  }
  std::ranges::sort(seen);
  EXPECT_EQ(ages.looks(), seen.size());
  EXPECT_EQ(ages.unknown(), unknown);
  for (const double q : {0.1, 0.5, 0.9, 0.99, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(seen.size()))) - 1;
    EXPECT_NEAR(ages.quantile_ms(q), seen[rank], 1e-3);
  }
}

TEST(AgeSamples, WhereNothingCameThereIsNoAge) {
  AgeSamples ages(at_ms(0), at_ms(100));
  ages.finish();
  EXPECT_EQ(ages.unknown(), 100U);
  EXPECT_TRUE(std::isnan(ages.quantile_ms(0.5)));
}

}  // namespace
}  // namespace pitwall::link
