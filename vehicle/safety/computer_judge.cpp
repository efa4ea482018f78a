// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/computer_judge.hpp"

#include <algorithm>

namespace pitwall::safety {

ComputerVerdict judge_computer(const ComputerParams& params, ComputerState& state,
                               const world::ComputerHealth& health, Instant now) {
  ComputerVerdict out;
  if (state.at != Instant{}) out.gap = now - state.at;
  state.at = now;
  out.missed = out.gap > kTickLate;
  const double lost_s = out.missed ? out.gap.seconds() : 0.0;
  state.late_s = std::clamp(state.late_s + lost_s - params.idle_share * out.gap.seconds(), 0.0,
                            2.0 * params.late_max_s);
  out.late = state.late_s > params.late_max_s;
  out.busy = health.processor_share > params.processor_warn;  // unset: false
  out.full = health.memory_mib > params.memory_max_mib;
  out.hot = health.temperature_c > params.temperature_max_c;
  return out;
}

}  // namespace pitwall::safety
