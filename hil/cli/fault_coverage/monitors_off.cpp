// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/fault_coverage/monitors_off.hpp"

namespace pitwall::fault_coverage {

void switch_off(pipeline::CarParams& params, world::MonitorSet monitors) {
  params.inbound.off = monitors;
  params.localization.off = monitors;
  params.watchdog.off = monitors;
  params.bus_guard.off = monitors;
  params.supervisor.faults.off = monitors;
}

}  // namespace pitwall::fault_coverage
