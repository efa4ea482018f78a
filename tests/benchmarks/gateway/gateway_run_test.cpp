// The experiment itself runs on real vcan, in tests/system/gateway.
// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/gateway_run.hpp"

#include <gtest/gtest.h>

namespace pitwall::benchmarks {
namespace {

TEST(GatewayRun, WithoutItsInterfaceNothingIsStarted) {
  const GatewayPlan plan{.interface = "nocan0",
                         .folder = "/no/such/folder",
                         .vehicle = {"no-such-program"},
                         .sender = {"no-such-program"},
                         .traffic = {.length = seconds(5)}};
  const auto run = run_gateway(plan);
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().place, "nocan0");
}

TEST(GatewayRun, ASenderWithoutItsInterfaceSaysSo) {
  const auto sent = send_traffic("nocan0", {.length = seconds(5)}, Instant{}, "/no/such/file");
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().place, "nocan0");
}

}  // namespace
}  // namespace pitwall::benchmarks
