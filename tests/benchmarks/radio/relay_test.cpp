// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/relay.hpp"

#include <gtest/gtest.h>

#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

TEST(Relay, ForwardsWhileItIsActiveAndNothingAfterwards) {
  VirtualRadio radio(setup_of(clean_link()));
  Relay relay(radio, kWay, milliseconds(1));
  radio.run(seconds(1));
  EXPECT_EQ(relay.forwarded(), 0u);
  relay.begin();
  for (int ms = 0; ms < 1'000; ++ms) relay.step(), radio.step();
  const std::uint64_t forwarded = relay.forwarded();
  EXPECT_GT(forwarded, 100u);
  EXPECT_GT(radio.base_report().association.relayed, 20u);
  relay.stop();
  for (int ms = 0; ms < 1'000; ++ms) relay.step(), radio.step();
  EXPECT_EQ(relay.forwarded(), forwarded);
}

}  // namespace
}  // namespace pitwall::radio
