// SPDX-License-Identifier: Apache-2.0
#include "tests/hil/link/fit.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hil/link/link_emulator.hpp"
#include "hil/link/trace.hpp"

namespace pitwall::link {
namespace {

std::vector<std::uint8_t> record_of(const Fades& fades, std::uint64_t seed, Duration period,
                                    Duration length) {
  LinkParams params;
  params.fades = fades;
  LinkEmulator link(params, seed);
  std::vector<std::uint8_t> lost;
  for (Instant at{}; at < Instant{} + length; at += period) {
    link.offer({}, at);
    lost.push_back(link.take(at) ? 0 : 1);
  }
  return lost;
}

// Also where datagrams are lost outside of fades, which a count of runs takes for short fades.
TEST(Fit, FindsTheFadesThatMadeTheRecord) {
  for (const Fades truth : {Fades{milliseconds(280), milliseconds(120), 0.0, 1.0},
                            Fades{milliseconds(280), milliseconds(120), 0.02, 0.95},
                            Fades{seconds(2), milliseconds(300), 0.05, 1.0}}) {
    const auto record = record_of(truth, 2, milliseconds(20), seconds(3'600));
    const auto fitted = fit_fades(record, milliseconds(20));
    ASSERT_TRUE(fitted) << to_string(fitted.error());
    const auto near = [](Duration is, Duration wanted) {
      EXPECT_NEAR(is.milliseconds(), wanted.milliseconds(), 0.06 * wanted.milliseconds());
    };
    near(fitted->mean_bad, truth.mean_bad);
    near(fitted->mean_good, truth.mean_good);
    EXPECT_NEAR(fitted->loss_good, truth.loss_good, 0.01);
    EXPECT_NEAR(fitted->loss_bad, truth.loss_bad, 0.02);
  }
}

TEST(Fit, FindsTheFadesOfATrace) {
  const Fades truth{milliseconds(280), milliseconds(120), 0.0, 1.0};
  const auto fitted = fit_fades(trace_of(truth, 3, seconds(3'600)));
  ASSERT_TRUE(fitted);
  EXPECT_NEAR(fitted->mean_bad.milliseconds(), 120.0, 6.0);
  EXPECT_NEAR(fitted->mean_good.milliseconds(), 280.0, 14.0);
  EXPECT_EQ(fitted->loss_bad, 1.0);
}

TEST(Fit, SaysWhereTheRecordIsTooShort) {
  const std::vector<std::uint8_t> none(100, 0), all(100, 1);
  for (const auto& record : {none, all}) {
    const auto fitted = fit_fades(record, milliseconds(20));
    ASSERT_FALSE(fitted);
    EXPECT_EQ(to_string(fitted.error()), "record: error: holds 0 bursts of loss; 20 are needed");
  }
  EXPECT_FALSE(fit_fades(LinkTrace{}));
}

TEST(Fit, SaysWhereLossComesInNoBursts) {
  std::vector<std::uint8_t> alternating(1'000);
  for (std::size_t i = 0; i < alternating.size(); ++i) alternating[i] = i % 2;
  EXPECT_FALSE(fit_fades(alternating, milliseconds(20)));
}

}  // namespace
}  // namespace pitwall::link
