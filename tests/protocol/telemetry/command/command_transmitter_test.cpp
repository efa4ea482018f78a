// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/command_transmitter.hpp"

#include <gtest/gtest.h>

#include "tests/protocol/telemetry/command/two_ends.hpp"

namespace pitwall::telemetry {
namespace {

using testing::TwoEnds;

TEST(CommandTransmitter, ABaseThatLearnsOfTheRestartDecidesWhatWasOpen) {
  TwoEnds rig({.seed = 7});
  rig.run(seconds(1));
  rig.up.cut = true;
  const auto old = rig.issue(CommandType::kArm, 1.0);
  rig.transmitter.set_peer_boot(TwoEnds::kCarBoot, rig.now);
  EXPECT_FALSE(outcome(rig, *old)) << "the same run of the car";
  rig.transmitter.set_peer_boot(TwoEnds::kCarBoot + 1, rig.now);
  EXPECT_EQ(outcome(rig, *old), Outcome::kOtherRun);
  EXPECT_EQ(rig.transmitter.open(), 0U);
}

TEST(CommandTransmitter, IssuesOnlyWhatItCanKeepItsWordOn) {
  CommandTransmitter transmitter(1);
  const Instant now{};
  EXPECT_FALSE(transmitter.issue({CommandType::kArm, 1.0, 1}, now)) << "no car was met";
  transmitter.set_peer_boot(2, now);
  EXPECT_FALSE(transmitter.issue({CommandType::kSpeedLimit, 120.1, 1}, now));
  EXPECT_FALSE(transmitter.issue({CommandType::kSpeedLimit, -0.1, 1}, now));
  EXPECT_FALSE(transmitter.issue({CommandType::kSpeedLimit, kUnset, 1}, now));
  for (std::size_t i = 0; i < CommandTransmitter::kOpen; ++i) {
    EXPECT_TRUE(transmitter.issue({CommandType::kSpeedLimit, 33.33, 1}, now));
  }
  EXPECT_FALSE(transmitter.issue({CommandType::kArm, 1.0, 1}, now));
  EXPECT_NEAR(transmitter.progress(1)->command.argument, 33.3, 1e-9)
      << "as the car will understand it";
  EXPECT_EQ(transmitter.progress(0), nullptr);
  EXPECT_EQ(transmitter.progress(17), nullptr);
  transmitter.confirm(1, now);
  EXPECT_FALSE(transmitter.progress(1)->confirmed) << "what was not applied cannot be confirmed";
}

TEST(CommandTransmitter, StagesComeInTheirOrder) {
  TwoEnds rig({.seed = 11});
  rig.run(seconds(1));
  const auto id = rig.issue(CommandType::kTrackFlag, 2.0);
  rig.run(seconds(1));
  rig.transmitter.confirm(*id, rig.now);
  const CommandProgress& p = *rig.transmitter.progress(*id);
  ASSERT_TRUE(p.sent && p.received && p.decided && p.confirmed);
  EXPECT_LE(p.issued, *p.sent);
  EXPECT_LT(*p.sent, *p.received);
  EXPECT_LE(*p.received, *p.decided);
  EXPECT_LT(*p.decided, *p.confirmed);
}

}  // namespace
}  // namespace pitwall::telemetry
