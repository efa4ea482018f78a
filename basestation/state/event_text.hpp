// Commands and events as text for people: one line each.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/telemetry/command/command_transmitter.hpp"
#include "protocol/telemetry/delivery/events.hpp"

namespace pitwall::state {

// "speed limit 30 m/s", "arm: arm"
std::string command_text(const telemetry::Command& command);
// "sent", "received by the car", "applied after 45 ms", "refused", ...
std::string progress_text(const telemetry::CommandProgress& progress, Instant now);
// "mode: standby -> driving", "lap 3: 45.210 s"
std::string event_text(const telemetry::Event& event);

}  // namespace pitwall::state
