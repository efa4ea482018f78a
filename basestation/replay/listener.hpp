// Interface that a replay calls, with the calls of a live base.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "protocol/recorder/channels.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::replay {

class Listener {
 public:
  virtual ~Listener() = default;
  // What of the state is newer, as VehicleState::update() has it.
  virtual void state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
                     Instant received) = 0;
  virtual void text(recorder::Topic topic, Instant at, std::string_view json) = 0;
  // Time jumps: everything that was told is forgotten, and what was known then follows.
  virtual void restart(Instant to) = 0;
};

}  // namespace pitwall::replay
