// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/monitoring.hpp"

#include <gtest/gtest.h>

namespace pitwall::pipeline {
namespace {

using world::Monitor;
using world::MonitorSet;

MonitorSet only(Monitor monitor) {
  MonitorSet set;
  set.add(monitor);
  return set;
}

TEST(Monitoring, WhatAnyModuleSeesIsSeen) {
  Outputs out;
  EXPECT_TRUE(seen(out, {}).empty());
  out.received.seen = only(Monitor::kCounter);
  out.watchdog.seen = only(Monitor::kStreamAge);
  out.bus_guard.seen = only(Monitor::kTransmitStall);
  out.chosen.seen = only(Monitor::kRaceControl);
  const MonitorSet all = seen(out, only(Monitor::kStamp));
  for (const Monitor m : {Monitor::kCounter, Monitor::kStreamAge, Monitor::kTransmitStall,
                          Monitor::kRaceControl, Monitor::kStamp}) {
    EXPECT_TRUE(all.has(m)) << world::kMonitorNames[static_cast<std::size_t>(m)];
  }
  EXPECT_FALSE(all.has(Monitor::kBusLoad));
}

TEST(Monitoring, EveryMonitorHasItsOwnName) {
  for (std::size_t i = 0; i < world::kMonitors; ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(world::kMonitorNames[i], world::kMonitorNames[k]);
  }
}

}  // namespace
}  // namespace pitwall::pipeline
