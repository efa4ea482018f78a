// Race fields of the base: roles, attempts, gaps, the flag that the base relays.
//   invariants
//          gaps are to the opponents that are known now; without any, to the last known position of
//          opponent 1, with the age of that. Number and state of the attempt have the age of the
//          track flag, its laps that of the lap number
//   units  as in station_field.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "basestation/state/derived/derive.hpp"
#include "basestation/state/derived/pass.hpp"

namespace pitwall::state {

void derive_race(const Pass& pass, const Known& known, const MonitorState& monitors,
                 const rules::FuelPlan& plan, const Course* course);

}  // namespace pitwall::state
