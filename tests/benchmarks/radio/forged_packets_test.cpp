// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/forged_packets.hpp"

#include <gtest/gtest.h>

#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

TEST(PacketForger, NothingThatHeSendsIsTakenForTheEnds) {
  VirtualRadio radio(setup_of(clean_link()));
  const ForgeryFigures figures = run_forgeries(radio, 20'000, 10);
  EXPECT_GE(figures.total(), 20'000u);
  for (const std::uint64_t sent : figures.sent) EXPECT_GE(sent, 2'000u);
  EXPECT_EQ(figures.accepted, 0u);
  EXPECT_EQ(radio.content_errors().all(), 0u);
  EXPECT_GT(radio.arrivals(), 50u);
}

TEST(PacketForger, AFloodMakesNothingOlder) {
  VirtualRadio calm(setup_of(clean_link())), flooded(setup_of(clean_link()));
  PacketForger forger(flooded, 3);
  for (VirtualRadio* radio : {&calm, &flooded}) radio->run(seconds(2));
  for (int ms = 0; ms < 2'000; ++ms) {
    flooded.step();
    forger.flood(200);
    calm.step();
  }
  const auto safety = telemetry::Group::kMode;
  EXPECT_LE(flooded.ages().quantile(safety, 0.99),
            calm.ages().quantile(safety, 0.99) + milliseconds(5));
}

// A forger who is one of the ends is noticed: the counting works.
TEST(PacketForger, WhatIsGenuineWouldBeCounted) {
  VirtualRadio radio(setup_of(clean_link()));
  std::vector<std::uint8_t> stolen;
  radio.run(seconds(1));
  radio.tap([&](bool down, telemetry::PathId, std::span<const std::uint8_t> bytes) {
    if (!down || !stolen.empty()) return true;
    stolen.assign(bytes.begin(), bytes.end());
    return false;
  });
  radio.run(milliseconds(100));
  const std::uint64_t before = radio.base_report().association.opened;
  radio.inject(true, 0, {0x0A0000FE, 6'666}, stolen);
  EXPECT_EQ(radio.base_report().association.opened, before + 1);
}

}  // namespace
}  // namespace pitwall::radio
