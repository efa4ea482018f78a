// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/fault_coverage/monitors_off.hpp"

#include <gtest/gtest.h>

namespace pitwall::fault_coverage {
namespace {

TEST(MonitorsOff, EveryModuleIsToldWhatIsOff) {
  world::MonitorSet innovation;
  innovation.add(world::Monitor::kInnovation);
  pipeline::CarParams params;
  for (const world::MonitorSet& off : {innovation, world::MonitorSet{}}) {
    switch_off(params, off);
    EXPECT_EQ(params.inbound.off, off);
    EXPECT_EQ(params.localization.off, off);
    EXPECT_EQ(params.watchdog.off, off);
    EXPECT_EQ(params.bus_guard.off, off);
    EXPECT_EQ(params.supervisor.faults.off, off);
  }
}

}  // namespace
}  // namespace pitwall::fault_coverage
