// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/bus_faults.hpp"

#include <gtest/gtest.h>

#include "hil/bench/rig.hpp"

namespace pitwall::bench {
namespace {

using faults::BenchFault;
using faults::BenchFaultKind;
using world::ControllerState;

constexpr auto kCar = static_cast<std::uint8_t>(Node::kCar);
constexpr Instant kStart = Instant{} + seconds(1);

struct Bench {
  can_bus::MemoryBus bus{{.ports = kNodes}};
  BusFaults faults;
  Instant now = kStart;

  explicit Bench(const BenchFault& fault) : faults({fault}) {}
  // The car speaks every 10 ms.
  void run(Duration time) {
    for (const Instant end = now + time; now < end; now += milliseconds(1)) {
      can::Frame frame;
      frame.id = 0x200;
      frame.length = 8;
      if ((now - kStart).ns % milliseconds(10).ns == 0) bus.offer(kCar, frame, now);
      faults.act_on(bus, now);
      bus.advance(now + milliseconds(1));
    }
  }
  world::LinkObservation link() const { return link_of_car(bus); }
};

BenchFault fault(BenchFaultKind kind, double value = 0.0) {
  return {.kind = kind,
          .start = kStart + milliseconds(100),
          .duration = milliseconds(50),
          .value = value};
}

TEST(BusFaults, BeforeAFaultTheLinkIsWell) {
  Bench bench{fault(BenchFaultKind::kBusTransmitter, 1.0)};
  bench.run(milliseconds(100));
  EXPECT_EQ(bench.link().controller, ControllerState::kActive);
  EXPECT_EQ(bench.link().error_frames, 0u);
  EXPECT_EQ(bench.link().tx_stalled, Duration{});
}

TEST(BusFaults, ABrokenTransmitterIsBusOffUntilItIsRestarted) {
  Bench bench{fault(BenchFaultKind::kBusTransmitter, 1.0)};
  bench.run(milliseconds(110));
  EXPECT_EQ(bench.link().controller, ControllerState::kBusOff);
  EXPECT_EQ(bench.link().error_frames, 32u);
  EXPECT_GT(bench.link().tx_drops, 0u);
  bench.run(milliseconds(200));
  EXPECT_EQ(bench.link().controller, ControllerState::kBusOff);
  EXPECT_TRUE(bench.bus.restart(kCar, bench.now));
  bench.run(milliseconds(20));
  EXPECT_EQ(bench.link().controller, ControllerState::kActive);
  EXPECT_EQ(bench.link().restarts, 1u);
  EXPECT_EQ(bench.link().tx_stalled, Duration{});
}

TEST(BusFaults, AStallIsAsLongAsNothingIsSent) {
  Bench bench{fault(BenchFaultKind::kTransmitStall)};
  bench.run(milliseconds(140));
  EXPECT_GE(bench.link().tx_stalled, milliseconds(29));
  EXPECT_EQ(bench.link().controller, ControllerState::kActive);
  bench.run(milliseconds(20));
  EXPECT_EQ(bench.link().tx_stalled, Duration{});
}

// As where a driver's queue hangs: what cures it is a restart, of a controller that is not bus-off.
TEST(BusFaults, AStallEndsWithARestartOfTheController) {
  Bench bench{fault(BenchFaultKind::kTransmitStall)};
  bench.faults.car_restarts_controller(bench.now);
  bench.run(milliseconds(120));
  EXPECT_GE(bench.link().tx_stalled, milliseconds(9)) << "a restart before the fault cures nothing";
  bench.faults.car_restarts_controller(bench.now);
  bench.run(milliseconds(10));
  EXPECT_EQ(bench.link().tx_stalled, Duration{});
  bench.run(milliseconds(15));
  EXPECT_EQ(bench.link().tx_stalled, Duration{}) << "and stays cured while the fault lasts";
}

TEST(BusFaults, ABabblerLeavesNoRoom) {
  Bench bench{fault(BenchFaultKind::kBusBabble, 1.0)};
  bench.run(milliseconds(100));
  const std::uint64_t before = bench.bus.sent_by(kCar);
  bench.run(milliseconds(50));
  EXPECT_LE(bench.bus.sent_by(kCar), before + 1);
  EXPECT_GT(bench.bus.sent_by(static_cast<std::uint8_t>(Node::kStranger)), 150u);
  bench.run(milliseconds(20));
  EXPECT_GE(bench.bus.sent_by(kCar), before + 2) << "it is over";
}

TEST(BusFaults, BitErrorsAreErrorFrames) {
  Bench bench{fault(BenchFaultKind::kBusErrors, 0.02)};
  bench.run(milliseconds(150));
  EXPECT_GT(bench.link().error_frames, 0u);
  const std::uint64_t then = bench.link().error_frames;
  bench.run(milliseconds(100));
  EXPECT_EQ(bench.link().error_frames, then);
}

}  // namespace
}  // namespace pitwall::bench
