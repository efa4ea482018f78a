// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/monitoring.hpp"

namespace pitwall::pipeline {

world::MonitorSet seen(const Outputs& out, world::MonitorSet by_localization) {
  world::MonitorSet all = by_localization;
  all.add(out.received.seen);
  all.add(out.watchdog.seen);
  all.add(out.bus_guard.seen);
  all.add(out.chosen.seen);
  return all;
}

}  // namespace pitwall::pipeline
