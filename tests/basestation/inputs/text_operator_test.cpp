// SPDX-License-Identifier: Apache-2.0
#include "basestation/inputs/text_operator.hpp"

#include <gtest/gtest.h>

#include "tests/basestation/radio_rig.hpp"

namespace pitwall::inputs {
namespace {

TEST(TextOperator, AStopPortTakesStopsOnly) {
  RadioRig pit;
  pit.run(seconds(1));
  TextOperator port{kStopPortPerson, Allowed::kStops};
  for (const char* const line : {"take", "command speed_limit 4", "joystick 0 1", "release"}) {
    const auto done = port.execute(line, pit.base->requests(), pit.now);
    ASSERT_FALSE(done) << line;
    EXPECT_NE(done.error().what.find("only stops"), std::string::npos);
    EXPECT_EQ(pit.base->requests().audit().lines().back().what, line);
  }
  EXPECT_EQ(pit.base->requests().refused(), 4U);
  EXPECT_TRUE(port.execute("stop controlled", pit.base->requests(), pit.now));
  EXPECT_EQ(pit.station->endpoint().stop().state().level, telemetry::StopLevel::kControlled);
}

TEST(TextOperator, OneConsoleHoldsTheAuthority) {
  RadioRig pit;
  pit.run(seconds(1));
  TextOperator other{kSocketPerson};
  const auto other_says = [&](std::string_view line) {
    return other.execute(line, pit.base->requests(), pit.now);
  };
  EXPECT_TRUE(pit.execute("take 1"));
  EXPECT_FALSE(other_says("take 5"));
  EXPECT_TRUE(pit.execute("renew"));
  EXPECT_FALSE(other_says("renew"));
  EXPECT_TRUE(other_says("request"));
  EXPECT_TRUE(pit.execute("refuse"));
  EXPECT_TRUE(other_says("request"));
  EXPECT_TRUE(pit.execute("grant"));
  EXPECT_EQ(pit.station->endpoint().authority().holder(pit.now), 5);
  EXPECT_FALSE(pit.execute("drop"));
  EXPECT_TRUE(other_says("drop"));
  EXPECT_TRUE(pit.execute("take"));
}

// What comes by UDP is anybody's of this machine: it makes no line of its own in a log.
TEST(TextOperator, TheAuditLineIsPrintableAndOneLine) {
  RadioRig pit;
  TextOperator port{kStopPortPerson, Allowed::kStops};
  EXPECT_FALSE(port.execute("fly\n\x1b[2Jaway\r\n", pit.base->requests(), pit.now));
  EXPECT_EQ(pit.base->requests().audit().lines().back().what, "fly??[2Jaway");
  EXPECT_FALSE(port.execute(std::string(5'000, 'x'), pit.base->requests(), pit.now));
  EXPECT_EQ(pit.base->requests().audit().lines().back().what, std::string(200, 'x'));
}

// The joystick is in the audit log when it begins and when it ends, and not in between.
TEST(TextOperator, OfAJoystickTheBeginningAndTheEndAreAudited) {
  RadioRig pit;
  pit.run(seconds(1));
  const std::uint64_t before = pit.base->requests().audit().count();
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(pit.execute("joystick 0.4 0.25"));
    pit.run(milliseconds(50));
  }
  EXPECT_EQ(pit.base->requests().audit().count(), before + 1);
  pit.run(seconds(1));
  ASSERT_EQ(pit.base->requests().audit().count(), before + 2);
  EXPECT_EQ(pit.base->requests().audit().lines().back().result, "no longer in use");
  ASSERT_TRUE(pit.execute("joystick 0.4 0.25"));
  EXPECT_EQ(pit.base->requests().audit().count(), before + 3);
}

}  // namespace
}  // namespace pitwall::inputs
