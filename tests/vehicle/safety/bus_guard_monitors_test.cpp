// What the guard's monitors see, and that one that is off sees and restarts nothing.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "vehicle/safety/bus_guard.hpp"

namespace pitwall::safety {
namespace {

using world::ControllerState;
using world::LinkObservation;
using world::Monitor;
using world::MonitorSet;

constexpr Instant kGuardTime{seconds(1).ns};

MonitorSet seen_by(const BusGuardParams& params, const LinkObservation& link) {
  BusGuardState state;
  return guard(params, state, link, false, kGuardTime).seen;
}

MonitorSet only(Monitor monitor) {
  MonitorSet set;
  set.add(monitor);
  return set;
}

TEST(BusGuardMonitors, AHealthyBusIsSeenAsOne) {
  EXPECT_TRUE(seen_by({}, {}).empty()) << "a bus without a known controller state";
  EXPECT_TRUE(seen_by({}, {.controller = ControllerState::kActive, .load = 0.5}).empty());
}

TEST(BusGuardMonitors, EachStateOfTheControllerButActive) {
  for (const auto state : {ControllerState::kWarning, ControllerState::kPassive,
                           ControllerState::kBusOff, ControllerState::kDown})
    EXPECT_EQ(seen_by({}, {.controller = state}), only(Monitor::kControllerState));
}

TEST(BusGuardMonitors, AnErrorFrameIsNewsOnce) {
  BusGuardState state;
  LinkObservation link{.controller = ControllerState::kActive};
  EXPECT_TRUE(guard({}, state, link, false, kGuardTime).seen.empty());
  link.error_frames = 1;
  EXPECT_EQ(guard({}, state, link, false, kGuardTime).seen, only(Monitor::kControllerState));
  EXPECT_TRUE(guard({}, state, link, false, kGuardTime).seen.empty());
}

TEST(BusGuardMonitors, LoadAndStallHaveTheirLimits) {
  const BusGuardParams params;
  EXPECT_TRUE(seen_by(params, {.load = params.load_max}).empty());
  EXPECT_EQ(seen_by(params, {.load = params.load_max + 1e-9}), only(Monitor::kBusLoad));
  EXPECT_TRUE(seen_by(params, {.tx_stalled = params.stall_seen - nanoseconds(1)}).empty());
  EXPECT_EQ(seen_by(params, {.tx_stalled = params.stall_seen}), only(Monitor::kTransmitStall));
}

TEST(BusGuardMonitors, OneThatIsOffSeesAndRestartsNothing) {
  const LinkObservation off{.controller = ControllerState::kBusOff, .error_frames = 7};
  const LinkObservation stalled{.tx_stalled = seconds(1)};
  const auto restarts = [](const BusGuardParams& params, const LinkObservation& link) {
    BusGuardState state;
    int count = 0;
    for (int tick = 0; tick < 100; ++tick) {
      const auto out = guard(params, state, link, false, kGuardTime + milliseconds(10) * tick);
      count += out.restart_now ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(restarts({}, off), 0);
  EXPECT_GT(restarts({}, stalled), 0);
  EXPECT_EQ(restarts({.off = only(Monitor::kControllerState)}, off), 0);
  EXPECT_EQ(restarts({.off = only(Monitor::kTransmitStall)}, stalled), 0);
  EXPECT_TRUE(seen_by({.off = only(Monitor::kControllerState)}, off).empty());
  EXPECT_TRUE(seen_by({.off = only(Monitor::kTransmitStall)}, stalled).empty());
  EXPECT_TRUE(seen_by({.off = only(Monitor::kBusLoad)}, {.load = 1.0}).empty());
}

}  // namespace
}  // namespace pitwall::safety
