// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/command_traffic.hpp"

#include <gtest/gtest.h>

#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

TEST(CommandTraffic, OnACleanLinkAllAreApplied) {
  VirtualRadio radio(setup_of(clean_link()));
  const CommandFigures f = run_commands(radio, 200, milliseconds(150));
  EXPECT_EQ(f.issued, 200u);
  EXPECT_EQ(f.applied, 200u);
  EXPECT_EQ(f.without_fate + f.twice + f.after_time + f.out_of_order + f.fate_differs, 0u);
  EXPECT_LE(f.quantile_ms(1.0), 50.0);
}

TEST(CommandTraffic, ALinkThatIsCutLeavesCommandsWithoutAFateAndItIsSeen) {
  VirtualRadio radio(setup_of(clean_link()));
  radio.run(seconds(1));
  radio.cut(0, true, true);
  const CommandFigures f = run_commands(radio, 10, milliseconds(150));
  EXPECT_EQ(f.without_fate, 10u);
  EXPECT_EQ(f.applied, 0u);
}

TEST(CommandTraffic, StopsLatchAndAreReleased) {
  VirtualRadio radio(setup_of(clean_link()));
  const StopFigures f = run_stops(radio, 20);
  EXPECT_EQ(f.trials, 20u);
  EXPECT_EQ(f.late + f.opened_alone + f.not_released, 0u);
}

}  // namespace
}  // namespace pitwall::radio
