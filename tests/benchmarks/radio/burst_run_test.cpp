// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/burst_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::radio {
namespace {

// A look sees an age above way + x where it falls into a fade that has lasted for x: with the share
// of fades and their mean b, share exp(-x / b).
TEST(BurstRun, TheOracleIsAsOldAsTheFadesAre) {
  for (const std::uint8_t paths : {std::uint8_t{1}, std::uint8_t{2}}) {
    double sum_ms = 0.0;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const BurstCase c{.fade = milliseconds(50), .paths = paths, .seed = seed};
      sum_ms += oracle_of(c).p99.milliseconds();
    }
    // Two independent paths: both are faded, and since the later of the two began.
    const double share = std::pow(0.3, paths), mean_ms = 50.0 / paths;
    const double expected_ms = 16.0 + mean_ms * std::log(share / 0.01);
    EXPECT_NEAR(sum_ms / 3, expected_ms, 0.1 * expected_ms) << int{paths};
  }
}

TEST(BurstRun, AClearAirHasOnlyTheWay) {
  const BurstRun run = run_burst({.loss = 0.0, .length = seconds(30)});
  EXPECT_GE(run.oracle.p50, milliseconds(15));
  EXPECT_LE(run.oracle.p99, milliseconds(18));
  EXPECT_LE(run.of(telemetry::Class::kSafety).p99, milliseconds(60));
  EXPECT_NE(to_string({}, run).find("oracle"), std::string::npos);
}

TEST(BurstRun, BreaksWhereAnyOfItsLawsDoes) {
  BurstRun run;
  run.oracle = {milliseconds(20), milliseconds(400), milliseconds(700)};
  run.classes[0] = {milliseconds(30), milliseconds(445), milliseconds(760)};
  run.classes[1] = {milliseconds(30), milliseconds(460), milliseconds(760)};
  EXPECT_TRUE(run.holds());
  for (int which = 0; which < 6; ++which) {
    BurstRun bad = run;
    if (which == 0) bad.classes[0].p99 = bad.classes[0].p99 + milliseconds(1);
    if (which == 1) bad.classes[0].p999 = bad.classes[0].p999 + milliseconds(1);
    if (which == 2) bad.classes[1].p99 = bad.classes[1].p99 + milliseconds(1);
    if (which == 3) bad.classes[1].p999 = bad.classes[1].p999 + milliseconds(1);
    if (which == 4) bad.slow_p99 = 1.21;
    if (which == 5) bad.content_errors.too_young = 1;
    EXPECT_FALSE(bad.holds()) << which;
  }
}

}  // namespace
}  // namespace pitwall::radio
