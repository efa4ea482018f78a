// A V14 car on the bus of another revision, in lockstep.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "hil/bench/lockstep/lockstep.hpp"
#include "protocol/can/av21.hpp"
#include "tests/hil/bench/flying_lap.hpp"

namespace pitwall::bench {
namespace {

struct WrongBus {
  const char* scenario;
  const char* sentence;
};
const WrongBus kCases[] = {
    {"wrong_bus_v9",
     "CAN id 1250 marelli_report_1: not heard for 3.5 s, every 500 ms in database CAN1-INDY-V14"},
    {"wrong_bus_v12", "CAN id 1000: 8 bytes on the bus, no such message in database CAN1-INDY-V14"},
    {"wrong_bus_av24",
     "CAN id 1303 steering_report: 8 bytes on the bus, 3 in database CAN1-INDY-V14"},
};

Loaded loaded_scenario(const std::string& name) {
  auto loaded = load(kRoot + "/hil/scenarios/" + name + ".yaml", kRoot);
  EXPECT_TRUE(loaded) << to_string(loaded.error());
  return *std::move(loaded);
}

TEST(WrongBus, TheCarSendsNoCommandAndSaysWhy) {
  for (const WrongBus& row : kCases) {
    const Loaded loaded = loaded_scenario(row.scenario);
    std::string log;
    LockstepOptions options;
    options.log = [&log](std::span<const std::uint8_t> bytes) {
      log.append(bytes.begin(), bytes.end());
      return true;
    };
    std::size_t commands = 0, other_frames = 0;
    options.watch = [&](const pipeline::Outputs& out, const Rig&, Instant) {
      EXPECT_EQ(out.chosen.mode, world::Mode::kDisarmed);
      for (const can::Frame& frame : out.passed.frames)
        ++(frame.id <= 1403 ? commands : other_frames);
    };
    const auto run = run_lockstep(loaded.scenario, loaded.setup, options);
    ASSERT_TRUE(run) << to_string(run.error());
    EXPECT_TRUE(run->passed()) << to_text(*run);
    EXPECT_EQ(commands, 0u) << row.scenario;
    EXPECT_GT(other_frames, 1000u) << "it reports its state all the same";
    EXPECT_EQ(run->refused_to_arm, row.sentence);
    EXPECT_NE(to_text(*run).find(std::string("car refused to arm: ") + row.sentence),
              std::string::npos);
    EXPECT_NE(to_json(*run).find(std::string("\"refused_to_arm\": \"") + row.sentence),
              std::string::npos);
    EXPECT_NE(log.find(row.sentence), std::string::npos) << "not in the event log";
    for (const char* key : {"database", "revision", "fingerprint"})
      EXPECT_NE(log.find(key), std::string::npos) << "the metadata lack the " << key;
    char fingerprint[20];
    std::snprintf(fingerprint, sizeof fingerprint, "%016llx",
                  static_cast<unsigned long long>(can::av21::kFingerprint));
    EXPECT_NE(log.find(fingerprint), std::string::npos);
  }
}

// The test of the tests: on its own bus the same car arms, and the same expectations fail.
TEST(WrongBus, OnItsOwnBusTheSameCarArms) {
  for (const WrongBus& row : kCases) {
    Loaded loaded = loaded_scenario(row.scenario);
    loaded.scenario.bus = scenario::BusRevision::kV14;
    Instant armed{};
    LockstepOptions options;
    options.watch = [&](const pipeline::Outputs& out, const Rig& rig, Instant now) {
      const bool right = out.received.bus.identity.verdict == world::IdentityVerdict::kRight;
      if (out.chosen.mode != world::Mode::kDisarmed && armed.ns == 0) armed = now;
      EXPECT_FALSE(out.received.race_control.conflict) << "both systems of race control agree";
      if (armed.ns != 0) {
        EXPECT_TRUE(right);
      }
      if (now - Instant{} == loaded.scenario.duration) {
        EXPECT_GT(rig.actuator_frames(), 1000u);
      }
    };
    const auto run = run_lockstep(loaded.scenario, loaded.setup, options);
    ASSERT_TRUE(run) << to_string(run.error());
    EXPECT_FALSE(run->passed());
    EXPECT_EQ(run->refused_to_arm, "");
    EXPECT_GT(armed.ns, 0);
    EXPECT_LE(armed - Instant{}, milliseconds(2200)) << "as soon as the slowest period allows";
  }
}

}  // namespace
}  // namespace pitwall::bench
