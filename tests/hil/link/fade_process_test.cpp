// SPDX-License-Identifier: Apache-2.0
#include "hil/link/fade_process.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pitwall::link {
namespace {

TEST(FadeProcess, TheTraceIsTheSameHoweverOftenItIsLookedAt) {
  const Fades fades = bursty(0.3, milliseconds(120), 0.0, {}).fades;
  FadeProcess often(fades, 8), rarely(fades, 8);
  for (Instant at{}; at < Instant{} + seconds(120); at += milliseconds(1)) {
    const bool bad = often.bad(at);
    if (at.ns % 97'000'000 == 0) {
      ASSERT_EQ(rarely.bad(at), bad);
    }
  }
}

// Exponential: the share of fades longer than t is exp(-t / mean), and the past does not matter.
TEST(FadeProcess, TimesInAStateAreExponential) {
  FadeProcess process(bursty(0.3, milliseconds(120), 0.0, {}).fades, 4);
  std::vector<double> bad_ms, good_ms;
  process.bad(Instant{});
  for (Instant at = process.until(); bad_ms.size() < 40'000;) {
    const bool bad = process.bad(at);
    (bad ? bad_ms : good_ms).push_back((process.until() - at).milliseconds());
    at = process.until();
  }
  const auto share_above = [](const std::vector<double>& all, double limit) {
    return static_cast<double>(std::ranges::count_if(all, [=](double x) { return x > limit; })) /
           static_cast<double>(all.size());
  };
  for (const double t : {0.1, 0.5, 1.0, 2.0, 4.0}) {
    EXPECT_NEAR(share_above(bad_ms, t * 120.0), std::exp(-t), 0.01);
    EXPECT_NEAR(share_above(good_ms, t * 280.0), std::exp(-t), 0.01);
  }
}

TEST(FadeProcess, IsStationaryFromItsStart) {
  const Fades fades = bursty(0.3, milliseconds(120), 0.0, {}).fades;
  int bad_at_start = 0;
  for (std::uint64_t seed = 0; seed < 10'000; ++seed)
    bad_at_start += FadeProcess(fades, seed).bad(Instant{}) ? 1 : 0;
  EXPECT_NEAR(bad_at_start, 3'000, 150);
}

TEST(FadeProcess, WithoutFadesTheAirIsGoodForEver) {
  FadeProcess process({}, 1);
  EXPECT_FALSE(process.bad(Instant{}));
  EXPECT_FALSE(process.bad(Instant{} + seconds(100'000)));
}

}  // namespace
}  // namespace pitwall::link
