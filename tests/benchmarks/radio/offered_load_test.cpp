// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/offered_load.hpp"

#include <gtest/gtest.h>

namespace pitwall::radio {
namespace {

RadioSetup clean() {
  RadioSetup setup;
  setup.down.fill(link::bursty(0.0, {}, 32'000.0, milliseconds(15)));
  setup.up = setup.down;
  return setup;
}

TEST(OfferedLoad, OffersAnObjectEach50Ms) {
  VirtualRadio radio(clean());
  OfferedLoad(32'000.0, 3.0).run(radio, seconds(5));
  const auto bulk = radio.car_report().bulk;
  EXPECT_EQ(radio.now(), Instant{} + seconds(5));
  EXPECT_EQ(bulk.objects, 100U);
  EXPECT_EQ(bulk.refused, 0U);
  EXPECT_GT(bulk.pieces, 500U);
}

TEST(OfferedLoad, NothingIsNothing) {
  VirtualRadio radio(clean());
  OfferedLoad(32'000.0, 0.0).run(radio, seconds(1));
  EXPECT_EQ(radio.car_report().bulk.objects, 0U);
}

TEST(OfferedLoad, StaysBelowTheLargestObject) {
  VirtualRadio radio(clean());
  OfferedLoad(1e6, 20.0).run(radio, milliseconds(100));
  EXPECT_EQ(radio.car_report().bulk.objects, 2U);
}

}  // namespace
}  // namespace pitwall::radio
