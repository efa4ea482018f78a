// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/corrections.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::state {

void CorrectionMonitor::receive(std::size_t unit, double correction_age_s, double satellites,
                                Instant at) {
  Unit& one = units_.at(unit);
  if (satellites < kSatellites) {
    one.sky_lost = at;
    one.flows_since.reset();
    one.was_silent = true;
    return;
  }
  if (!std::isfinite(correction_age_s)) return;
  const Instant newest = at - from_seconds(correction_age_s);
  if (at - newest <= kSilence) {
    // A stream whose beginning nobody saw is not a short one.
    if (one.was_silent && !one.flows_since) one.flows_since = newest;
    one.was_silent = false;
    return;
  }
  if (one.flows_since && newest - *one.flows_since < kSession && !sky_lost_near(one, newest)) {
    lose(unit, newest);
  }
  one.flows_since.reset();
  one.was_silent = true;
}

bool CorrectionMonitor::sky_lost_near(const Unit& unit, Instant at) const {
  return unit.sky_lost && at - *unit.sky_lost < kSession;
}

void CorrectionMonitor::lose(std::size_t unit, Instant at) {
  units_[unit].lost = at;
  const std::optional<Instant>& other = units_[1 - unit].lost;
  if (!other) return;
  const Duration apart = at > *other ? at - *other : *other - at;
  if (apart > kTogether) return;
  losses_[count_++ % kLosses] = std::max(at, *other);
  for (Unit& one : units_) one.lost.reset();
}

bool CorrectionMonitor::conflict(Instant now) const {
  if (count_ < kLosses) return false;
  return std::all_of(losses_.begin(), losses_.end(),
                     [now](Instant at) { return now - at <= kWindow; });
}

}  // namespace pitwall::state
