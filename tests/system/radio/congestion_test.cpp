// A link that carries less than its budget says: the queue before the air grows. Both ends notice
// by the delay and take back their rate, so that what the operator sees does not grow old with it.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/benchmarks/radio/burst_run.hpp"
#include "tests/benchmarks/radio/offered_load.hpp"
#include "tests/benchmarks/radio/virtual_radio.hpp"
#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

using telemetry::Class;

// The queue of the emulator holds 16 KiB: at three quarters of the rate, two thirds of a second.
// Of a link that fades as well: loss says nothing, the delay between the fades does.
TEST(Congestion, AlsoWhereItFades) {
  RadioSetup setup = fading(0.3, milliseconds(120), 1);
  for (auto* links : {&setup.down, &setup.up}) {
    for (auto& link : *links) link.rate_bytes_per_s = 0.75 * kRate;
  }
  VirtualRadio radio(setup);
  OfferedLoad load(kRate, 3.0);
  load.run(radio, seconds(15));
  radio.reset_ages();
  constexpr int kSeconds = 120;
  double factor = 0.0;  // a saw tooth: its mean is what the link carries
  for (int i = 0; i < kSeconds; ++i) {
    load.run(radio, seconds(1));
    factor += radio.car_report().paths[0].rate_factor / kSeconds;
  }
  const AgeQuantiles safety = ages_of(radio, Class::kSafety);
  std::printf("and fades: safety p50 %.0f p99 %.0f ms, factor %.2f\n", safety.p50.milliseconds(),
              safety.p99.milliseconds(), factor);
  EXPECT_LT(factor, 0.9);
  EXPECT_GT(factor, 0.4);
  EXPECT_LE(safety.p50, milliseconds(120));
}

TEST(Congestion, TheQueueIsKeptShort) {
  for (const double share : {0.75, 0.5}) {
    RadioSetup setup = setup_of(clean_link(kRate * share));
    VirtualRadio radio(setup);
    OfferedLoad load(kRate, 3.0);
    load.run(radio, seconds(15));
    radio.reset_ages();
    load.run(radio, seconds(120));
    const AgeQuantiles safety = ages_of(radio, Class::kSafety);
    const auto report = radio.car_report().paths[0];
    std::printf(
        "link of %.2f of the budget: safety p50 %.0f p99 %.0f ms, factor %.2f, dropped %llu\n",
        share, safety.p50.milliseconds(), safety.p99.milliseconds(), report.rate_factor,
        static_cast<unsigned long long>(radio.down(0).counters().queue_full));
    EXPECT_LT(report.rate_factor, share * 1.15);
    EXPECT_GT(report.rate_factor, share * 0.5);
    EXPECT_LE(safety.p50, milliseconds(70));
    EXPECT_LE(safety.p99, milliseconds(150));
  }
}

}  // namespace
}  // namespace pitwall::radio
