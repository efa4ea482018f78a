// Monitor of the radio link of one car: losses, delays and rates over windows, measured ten times a
// second.
//   in     packets as they come; the radio's figures and the vehicle state, at each measurement
//   out    LinkFigures for derived signals and alarms; the meter with all its windows
//   units  shares 0 .. 1, kbit/s, ms
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "basestation/link/link_meter.hpp"
#include "basestation/link/station.hpp"
#include "basestation/state/known.hpp"
#include "basestation/state/vehicle_state.hpp"

namespace pitwall::service {

class LinkMonitor {
 public:
  void packet(telemetry::GroupSet groups, Instant now) { meter_.packet(groups, now); }
  state::LinkFigures measure(const link::Station& station, const state::VehicleState& vehicle,
                             Instant now);
  const link::LinkMeter& meter() const { return meter_; }

 private:
  link::LinkMeter meter_;
};

}  // namespace pitwall::service
