// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/system_state.hpp"

#include "protocol/vocabulary/check.hpp"

namespace pitwall::drive_by_wire {

using world::CtState;

bool happens(SystemEvent event, const SystemInputs& in) {
  const bool ready = in.ct >= CtState::kRaceReady && in.ct <= CtState::kCoordinatedStop;
  switch (event) {
    case SystemEvent::kAlways:
      return true;
    case SystemEvent::kCrankRequested:
      return in.ct == CtState::kCranking && in.orange && !in.engine_kill;
    case SystemEvent::kCrankWithdrawn:
      return in.ct != CtState::kCranking;
    case SystemEvent::kEngineRuns:
      return in.engine_running;
    case SystemEvent::kEngineStopped:
      return !in.engine_running;
    case SystemEvent::kReleased:
      return ready && !in.orange;
    case SystemEvent::kShutdown:
      return in.ct == CtState::kControlledShutdown || in.engine_kill;
    case SystemEvent::kEmergency:
      return in.ct == CtState::kEmergencyShutdown;
    case SystemEvent::kEmergencyOver:
      return in.ct != CtState::kEmergencyShutdown && in.standstill && !in.engine_running;
  }
  CHECK(false);
  return false;
}

world::SysState next_state(world::SysState state, Duration lasted, const SystemInputs& in) {
  for (const Transition& row : kTransitions)
    if (row.from == state && lasted >= row.dwell && happens(row.event, in)) return row.to;
  return state;
}

}  // namespace pitwall::drive_by_wire
