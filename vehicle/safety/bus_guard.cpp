// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/bus_guard.hpp"

#include <algorithm>

namespace pitwall::safety {
namespace {

bool is_down(const BusGuardParams& params, const world::LinkObservation& link) {
  return link.controller == world::ControllerState::kBusOff ||
         link.controller == world::ControllerState::kDown || link.tx_stalled >= params.stall_max;
}

std::size_t restarts_within(const BusGuardParams& params, const BusGuardState& state, Instant now) {
  return static_cast<std::size_t>(
      std::count_if(state.restarts.begin(), state.restarts.end(),
                    [&](Instant at) { return at != Instant{} && now - at < params.window; }));
}

void remember_restart(BusGuardState& state, Instant now) {
  std::rotate(state.restarts.begin(), state.restarts.begin() + 1, state.restarts.end());
  state.restarts.back() = now;
  ++state.restarts_total;
  ++state.tries;
}

// Down, and not yet given up.
bool restart_or_fail(const BusGuardParams& params, BusGuardState& state, bool begins, Instant now) {
  const bool spent = restarts_within(params, state, now) >= params.restarts;
  if (begins && spent) state.failed = true;  // a fresh bus-off: nothing is under way to wait for
  const Instant last = std::max(state.down_since, state.restarts.back());
  if (state.failed || now - last < params.pause) return false;
  state.failed = spent || state.tries >= params.restarts;
  if (!state.failed) remember_restart(state, now);
  return !state.failed;
}

}  // namespace

BusGuardOutput guard(const BusGuardParams& params, BusGuardState& state,
                     const world::LinkObservation& link, bool reset, Instant now) {
  const bool down = is_down(params, link);
  const bool begins = down && !state.down;
  if (begins) {
    state.down_since = now;
    state.tries = 0;
  }
  state.down = down;
  if (reset && !state.reset_was && !down) state.failed = false;
  state.reset_was = reset;
  const bool restart = down && !state.failed && restart_or_fail(params, state, begins, now);
  return {.restart_now = restart, .failed = state.failed};
}

}  // namespace pitwall::safety
