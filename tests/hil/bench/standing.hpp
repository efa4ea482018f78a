// Scenario that begins with the car at standstill, without faults; and a fault of one second for
// it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "tests/hil/bench/flying_lap.hpp"

namespace pitwall::bench {

inline scenario::Scenario standing() {
  scenario::Scenario s = lap().scenario;
  s.faults.clear();
  return s;
}

inline scenario::Fault fault_at(Duration at, std::string kind, double value = kUnset) {
  return {.kind = std::move(kind), .at = at, .lasts = seconds(1), .value = value, .place = "test"};
}

}  // namespace pitwall::bench
