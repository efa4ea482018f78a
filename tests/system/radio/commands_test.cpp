// Commands and stops through both ends: a definite fate for each, none twice, none late.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/benchmarks/radio/command_traffic.hpp"
#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

void expect_lawful(const CommandFigures& f) {
  EXPECT_EQ(f.without_fate, 0u);
  EXPECT_EQ(f.twice, 0u);
  EXPECT_EQ(f.after_time, 0u);
  EXPECT_EQ(f.out_of_order, 0u);
  EXPECT_EQ(f.fate_differs, 0u);
}

// So far that hardly one is superseded, and so near that most are.
constexpr Duration kApart = milliseconds(150), kDense = milliseconds(20);

void print(const char* what, const CommandFigures& f) {
  std::printf("%-24s %6lu issued, %6lu applied, time to apply p50 %5.0f p99 %5.0f ms\n", what,
              static_cast<unsigned long>(f.issued), static_cast<unsigned long>(f.applied),
              f.quantile_ms(0.5), f.quantile_ms(0.99));
}

TEST(Commands, HalfOfThePacketsLostOneRadio) {
  VirtualRadio radio(lossy(0.5, 1));
  const CommandFigures f = run_commands(radio, 1'500, kApart);
  print("50 % of each, one radio", f);
  expect_lawful(f);
  EXPECT_LE(f.quantile_ms(0.99), 160.0);
}

TEST(Commands, HalfOfThePacketsLostTwoRadios) {
  VirtualRadio radio(lossy(0.5, 2, 2));
  const CommandFigures f = run_commands(radio, 1'500, kApart);
  print("50 % of each, two radios", f);
  expect_lawful(f);
  EXPECT_LE(f.quantile_ms(0.99), 100.0);
}

TEST(Commands, FadesOneRadio) {
  VirtualRadio radio(fading(0.5, milliseconds(120), 3));
  const CommandFigures f = run_commands(radio, 1'500, kApart);
  print("50 % of 120 ms, one", f);
  expect_lawful(f);
  EXPECT_LE(f.quantile_ms(0.99), 600.0);
}

TEST(Commands, FadesTwoRadios) {
  VirtualRadio radio(fading(0.5, milliseconds(120), 4, 2));
  const CommandFigures f = run_commands(radio, 1'500, kApart);
  print("50 % of 120 ms, two", f);
  expect_lawful(f);
  EXPECT_LE(f.quantile_ms(0.99), 270.0);
}

TEST(Commands, ReorderedDuplicatedAndCorrupted) {
  RadioSetup setup = lossy(0.3, 5);
  for (auto* link : {&setup.down[0], &setup.up[0]}) {
    link->duplicate = 0.3;
    link->reorder = 0.3;
    link->reorder_by = milliseconds(70);
    link->corrupt = 0.1;
  }
  VirtualRadio radio(setup);
  expect_lawful(run_commands(radio, 3'000, kDense));
  EXPECT_EQ(radio.content_errors().all(), 0u);
}

TEST(Stop, LatchesWithTheFirstPacketThatArrives) {
  StopFigures f;
  for (const std::uint64_t seed : {1U, 2U}) {
    VirtualRadio radio(lossy(0.5, seed));
    f += run_stops(radio, 300);
  }
  EXPECT_EQ(f.trials, 600u);
  EXPECT_EQ(f.late, 0u);
  EXPECT_EQ(f.opened_alone, 0u);
  EXPECT_EQ(f.not_released, 0u);
}

}  // namespace
}  // namespace pitwall::radio
