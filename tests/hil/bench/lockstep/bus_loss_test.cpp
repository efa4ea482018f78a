// Frames that the bench drops, and what the car says about them, in the closed loop.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>

#include "hil/bench/lockstep/lockstep.hpp"
#include "tests/hil/bench/flying_lap.hpp"

namespace pitwall::bench {
namespace {

struct Counted {
  std::map<std::uint32_t, std::uint64_t> received, reported;  // frames by identifier
  std::uint64_t lost = 0;                                     // as the car counts
};

Counted run_with(const std::vector<scenario::Fault>& faults) {
  scenario::Scenario part = lap().scenario;
  part.duration = seconds(20);
  part.faults = faults;
  part.expect.clear();
  Counted counted;
  LockstepOptions options;
  options.step = [&counted](const pipeline::Setup& setup, pipeline::Car& car,
                            const pipeline::Inputs& in) {
    for (const can::ReceivedFrame& received : in.can) ++counted.received[received.frame.id];
    const pipeline::Outputs out = pipeline::step(setup, car, in);
    for (const world::LossReport& loss : out.received.bus.losses)
      counted.reported[loss.id] += loss.frames;
    return out;
  };
  const auto run = run_lockstep(part, lap().setup, options);
  EXPECT_TRUE(run);
  if (run) counted.lost = run->bus_losses;
  return counted;
}

const Counted& healthy() {
  static const Counted counted = run_with({});
  return counted;
}

TEST(BusLoss, AHealthyBusLosesNothing) {
  EXPECT_TRUE(healthy().reported.empty());
  EXPECT_EQ(healthy().lost, 0u);
}

TEST(BusLoss, AsManyFramesAreReportedAsWereDropped) {
  // Fast and slow, with a counter and without.
  for (const std::uint32_t id : {1300U, 1303U, 1304U, 1310U, 1324U, 1343U}) {
    const Counted counted = run_with({{.kind = "drop",
                                       .at = seconds(4),
                                       .lasts = seconds(12),
                                       .can_id = id,
                                       .value = 0.3,
                                       .place = "test"}});
    const std::uint64_t dropped = healthy().received.at(id) - counted.received.at(id);
    EXPECT_GT(dropped, 0u) << id;
    EXPECT_EQ(counted.reported.size(), 1u) << id;
    EXPECT_EQ(counted.reported.count(id) ? counted.reported.at(id) : 0, dropped) << id;
    EXPECT_EQ(counted.lost, dropped) << id;
  }
}

}  // namespace
}  // namespace pitwall::bench
