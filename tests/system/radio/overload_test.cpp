// Safety does not wait behind bulk: however much more is offered than the link carries, the state
// at the base is as young as the air allows.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "hil/radio/burst_run.hpp"
#include "hil/radio/offered_load.hpp"
#include "hil/radio/virtual_radio.hpp"
#include "protocol/telemetry/packet/header.hpp"
#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

using telemetry::Class;
using telemetry::Direction;
using telemetry::GroupRow;
using telemetry::kGroupTable;

void print(const char* what, double multiple, const AgeQuantiles& ages) {
  std::printf("%-8s offered %4.1fx: p50 %3.0f, p99 %3.0f, p99.9 %3.0f ms\n", what, multiple,
              ages.p50.milliseconds(), ages.p99.milliseconds(), ages.p999.milliseconds());
}

Duration worst_of(const VirtualRadio& radio, Class priority) {
  Duration worst{};
  for (const GroupRow& row : kGroupTable) {
    if (row.direction != Direction::kDown || row.priority != priority) continue;
    EXPECT_GT(radio.ages().looks(row.group), 0U) << row.name;
    worst = std::max(worst, radio.ages().worst(row.group));
  }
  return worst;
}

class Overload : public ::testing::TestWithParam<double> {};

TEST_P(Overload, SafetyStaysYoung) {
  VirtualRadio radio(setup_of(clean_link()));
  OfferedLoad load(kRate, GetParam());
  load.run(radio, seconds(5));
  radio.reset_ages();
  load.run(radio, seconds(120));

  const AgeQuantiles safety = ages_of(radio, Class::kSafety),
                     motion = ages_of(radio, Class::kMotion);
  print("safety", GetParam(), safety);
  print("motion", GetParam(), motion);
  print("health", GetParam(), ages_of(radio, Class::kHealth));
  EXPECT_LE(safety.p50, milliseconds(40));
  EXPECT_LE(safety.p99, milliseconds(60));
  EXPECT_LE(worst_of(radio, Class::kSafety), milliseconds(80));
  EXPECT_LE(motion.p99, milliseconds(80));
  // What safety leaves, bulk has.
  const auto down = radio.car_report().paths[0];
  const double used = static_cast<double>(down.spent.bytes) / (kRate * 125.0);
  std::printf("used of the rate: %.3f\n", used);
  EXPECT_GT(used, GetParam() >= 1.0 ? 0.94 : 0.2);
  EXPECT_LE(used, 1.0);
  EXPECT_EQ(down.rate_factor, 1.0);
  EXPECT_EQ(radio.falsehoods().too_young, 0U);
  EXPECT_EQ(radio.falsehoods().never_sampled, 0U);
}

// On any link: a slot to wait, the largest packet before it and its own on the air, and the way.
TEST(OverloadOfAnyLink, SafetyWaitsForTwoPacketsAtMost) {
  for (const double kbit_per_s : {64.0, 128.0, 512.0, 1'024.0}) {
    const double rate = kbit_per_s * 125.0;
    RadioSetup setup = setup_of(clean_link(rate));
    for (auto& budget : setup.budget_down) budget.bytes_per_s = rate;
    for (auto& budget : setup.budget_up) budget.bytes_per_s = rate;
    VirtualRadio radio(setup);
    OfferedLoad load(rate, 3.0);
    load.run(radio, seconds(5));
    radio.reset_ages();
    load.run(radio, seconds(60));
    const auto budget = telemetry::PathBudget::make(setup.budget_down[0]);
    const auto largest = static_cast<double>(budget->largest_payload() + telemetry::kIpUdpOverhead);
    const AgeQuantiles safety = ages_of(radio, Class::kSafety);
    std::printf("%4.0f kbit/s ", kbit_per_s);
    print("safety", 3.0, safety);
    std::printf("%4.0f kbit/s ", kbit_per_s);
    print("motion", 3.0, ages_of(radio, Class::kMotion));
    EXPECT_LE(safety.p99,
              milliseconds(20) + from_seconds(2.0 * largest / rate) + kWay + milliseconds(10));
  }
}

INSTANTIATE_TEST_SUITE_P(Offered, Overload, ::testing::Values(0.0, 1.0, 3.0, 20.0));

}  // namespace
}  // namespace pitwall::radio
