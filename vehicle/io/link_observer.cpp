// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/link_observer.hpp"

#include <algorithm>

namespace pitwall::io {
namespace {

using transport::BusState;
using world::ControllerState;

ControllerState state_of(BusState state) {
  switch (state) {
    case BusState::kUnknown:
      return ControllerState::kUnknown;
    case BusState::kActive:
      return ControllerState::kActive;
    case BusState::kWarning:
      return ControllerState::kWarning;
    case BusState::kPassive:
      return ControllerState::kPassive;
    case BusState::kBusOff:
      return ControllerState::kBusOff;
  }
  return ControllerState::kUnknown;
}

ControllerState judge(const LinkEvents& events) {
  const transport::CanInterfaceStatus& report = events.interface;
  if (events.hung_up || !report.exists || !report.up) return ControllerState::kDown;
  const bool reported = report.has_controller && report.state != BusState::kUnknown;
  if (!reported) return state_of(events.reported_by_frames);
  if (events.reported_at > report.at) return state_of(events.reported_by_frames);
  if (events.reported_at < report.at) return state_of(report.state);
  return std::max(state_of(events.reported_by_frames), state_of(report.state));
}

}  // namespace

world::LinkObservation LinkObserver::observe(const LinkEvents& events) {
  const transport::CanInterfaceStatus& report = events.interface;
  return {.controller = judge(events),
          .lost_in_socket = events.lost_in_socket,
          .lost_in_interface = lost_.follow(report.exists ? report.lost() : 0),
          .error_frames = events.error_frames,
          .tx_drops = events.tx_drops,
          .restarts = restarts_.follow(report.exists ? report.restarts : 0) + events.down_and_up,
          .tx_stalled = events.tx_stalled};
}

}  // namespace pitwall::io
