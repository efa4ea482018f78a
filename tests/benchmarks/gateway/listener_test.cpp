// What it hears is tested on real vcan by tests/system/gateway.
// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/listener.hpp"

#include <gtest/gtest.h>

namespace pitwall::load {
namespace {

TEST(Listener, AnInterfaceThatIsNotThereIsAProblemWithItsName) {
  const Traffic traffic{{.length = seconds(5)}};
  const auto opened = Listener::open("nocan0", traffic);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().place, "nocan0");
}

}  // namespace
}  // namespace pitwall::load
