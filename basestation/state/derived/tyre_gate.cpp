// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/tyre_gate.hpp"

namespace pitwall::state {
namespace {

double between(double from, double to, double t) { return from + t * (to - from); }

}  // namespace

double tyre_needed_c(const TyreGate& gate, double speed_mps) {
  if (speed_mps < gate.speed_mps.front()) return kNoTyreGate_c;
  for (std::size_t i = 1; i < TyreGate::kRows; ++i) {
    if (!(speed_mps < gate.speed_mps[i])) continue;  // no number, too: the last row
    const double t =
        (speed_mps - gate.speed_mps[i - 1]) / (gate.speed_mps[i] - gate.speed_mps[i - 1]);
    return between(gate.temperature_c[i - 1], gate.temperature_c[i], t);
  }
  return gate.temperature_c.back();
}

double speed_allowed_mps(const TyreGate& gate, double tyre_c) {
  constexpr double kAny_mps = 120.0;  // as far as a speed limit goes
  if (!(tyre_c >= gate.temperature_c.front())) return gate.speed_mps.front();
  for (std::size_t i = 1; i < TyreGate::kRows; ++i) {
    if (tyre_c >= gate.temperature_c[i]) continue;
    const double t =
        (tyre_c - gate.temperature_c[i - 1]) / (gate.temperature_c[i] - gate.temperature_c[i - 1]);
    return between(gate.speed_mps[i - 1], gate.speed_mps[i], t);
  }
  return kAny_mps;
}

}  // namespace pitwall::state
