// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/tyre_gate.hpp"

namespace pitwall::state {

double tyre_needed_c(const TyreGate& gate, double speed_mps) {
  if (speed_mps < gate.speed_mps.front()) return kNoTyreGate_c;
  for (std::size_t i = 1; i < TyreGate::kRows; ++i) {
    if (!(speed_mps < gate.speed_mps[i])) continue;  // no number, too: the last row
    const double t =
        (speed_mps - gate.speed_mps[i - 1]) / (gate.speed_mps[i] - gate.speed_mps[i - 1]);
    return gate.temperature_c[i - 1] + t * (gate.temperature_c[i] - gate.temperature_c[i - 1]);
  }
  return gate.temperature_c.back();
}

}  // namespace pitwall::state
