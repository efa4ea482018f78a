// What it hears is tested on real vcan by tests/system/gateway.
// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/queue_probe.hpp"

#include <gtest/gtest.h>

namespace pitwall::load {
namespace {

TEST(QueueProbe, AnInterfaceThatIsNotThereIsAProblemWithItsName) {
  const auto opened = QueueProbe::open("nocan0");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().place, "nocan0");
}

}  // namespace
}  // namespace pitwall::load
