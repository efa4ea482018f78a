// The race among the base's own fields: roles, attempts, gaps, the flag that the base relays.
//   invariants
//          a gap is to opponents that are known now; where none is, to the one that was known last,
//          as old as that. The attempt is as old as the flags that it is counted by
//   units  as own_field.hpp has them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "basestation/state/derived/derive.hpp"
#include "basestation/state/derived/pass.hpp"

namespace pitwall::state {

void derive_race(const Pass& pass, const Known& known, const MonitorState& monitors,
                 const FuelPlan& plan, const Course* course);

}  // namespace pitwall::state
