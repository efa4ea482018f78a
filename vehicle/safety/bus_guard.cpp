// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/bus_guard.hpp"

#include <algorithm>

namespace pitwall::safety {
namespace {

using world::ControllerState;
using world::Monitor;

bool is_down(const BusGuardParams& params, const world::LinkObservation& link) {
  const bool silent =
      link.controller == ControllerState::kBusOff || link.controller == ControllerState::kDown;
  return (silent && !params.off.has(Monitor::kControllerState)) ||
         (link.tx_stalled >= params.stall_max && !params.off.has(Monitor::kTransmitStall));
}

world::MonitorSet watch(const BusGuardParams& params, BusGuardState& state,
                        const world::LinkObservation& link) {
  world::MonitorSet seen;
  const auto add_if = [&](Monitor monitor, bool holds) {
    if (holds && !params.off.has(monitor)) seen.add(monitor);
  };
  const bool errors = link.error_frames > state.error_frames;
  state.error_frames = link.error_frames;
  add_if(Monitor::kBusLoad, link.load > params.load_max);
  add_if(Monitor::kControllerState, errors || (link.controller != ControllerState::kUnknown &&
                                               link.controller != ControllerState::kActive));
  add_if(Monitor::kTransmitStall, link.tx_stalled >= params.stall_seen);
  return seen;
}

std::size_t restarts_within(const BusGuardParams& params, const BusGuardState& state, Instant now) {
  return static_cast<std::size_t>(
      std::count_if(state.restarts.begin(), state.restarts.end(),
                    [&](Instant at) { return at != Instant{} && now - at < params.window; }));
}

void store_restart(BusGuardState& state, Instant now) {
  std::rotate(state.restarts.begin(), state.restarts.begin() + 1, state.restarts.end());
  state.restarts.back() = now;
  ++state.restarts_total;
  ++state.attempts;
}

// Down, and not yet given up.
bool restart_or_fail(const BusGuardParams& params, BusGuardState& state, bool begins, Instant now) {
  const bool spent = restarts_within(params, state, now) >= params.restarts;
  if (begins && spent) state.failed = true;  // a fresh bus-off: nothing is under way to wait for
  const Instant last = std::max(state.down_since, state.restarts.back());
  if (state.failed || now - last < params.pause) return false;
  state.failed = spent || state.attempts >= params.restarts;
  if (!state.failed) store_restart(state, now);
  return !state.failed;
}

}  // namespace

BusGuardOutput guard(const BusGuardParams& params, BusGuardState& state,
                     const world::LinkObservation& link, bool reset, Instant now) {
  const world::MonitorSet seen = watch(params, state, link);
  const bool down = is_down(params, link);
  const bool begins = down && !state.down;
  if (begins) {
    state.down_since = now;
    state.attempts = 0;
  }
  state.down = down;
  if (reset && !state.reset_was && !down) state.failed = false;
  state.reset_was = reset;
  const bool restart = down && !state.failed && restart_or_fail(params, state, begins, now);
  return {.restart_now = restart, .failed = state.failed, .seen = seen};
}

}  // namespace pitwall::safety
