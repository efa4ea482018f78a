// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "vehicle/pipeline/step.hpp"

namespace pitwall::pipeline {
namespace {

using world::Monitor;
using world::MonitorSet;

MonitorSet only(Monitor monitor) {
  MonitorSet set;
  set.add(monitor);
  return set;
}

TEST(Findings, WhatAnyModuleSeesIsSeen) {
  Outputs out;
  EXPECT_TRUE(findings_of(out, {}).empty());
  out.received.seen = only(Monitor::kCounter);
  out.watchdog.seen = only(Monitor::kStreamAge);
  out.bus_guard.seen = only(Monitor::kTransmitStall);
  out.chosen.seen = only(Monitor::kRaceControl);
  const MonitorSet all = findings_of(out, only(Monitor::kStamp));
  for (const Monitor m : {Monitor::kCounter, Monitor::kStreamAge, Monitor::kTransmitStall,
                          Monitor::kRaceControl, Monitor::kStamp}) {
    EXPECT_TRUE(all.has(m)) << world::kMonitorNames[static_cast<std::size_t>(m)];
  }
  EXPECT_FALSE(all.has(Monitor::kBusLoad));
}

TEST(Findings, EveryMonitorHasItsOwnName) {
  for (std::size_t i = 0; i < world::kMonitors; ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(world::kMonitorNames[i], world::kMonitorNames[k]);
  }
}

}  // namespace
}  // namespace pitwall::pipeline
