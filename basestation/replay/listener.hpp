// Listener of a replay: receives the same calls as in a live base.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "protocol/recorder/channels.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::replay {

class Listener {
 public:
  virtual ~Listener() = default;
  // `groups`: the groups of the state that are newer, as for VehicleState::update().
  virtual void state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
                     Instant received) = 0;
  virtual void text(recorder::Topic topic, Instant at, std::string_view json) = 0;
  // Time jumps: drop all earlier data; the data known at the new time follows.
  virtual void restart(Instant to) = 0;
};

}  // namespace pitwall::replay
