// Entry of the section `expect` of a scenario file: what a run has to show. A condition is
// `signal`, `is` (< <= > >= == !=) and `value`; the bench knows the signals
// (hil/bench/signals.hpp).
//   kind       what the condition is asked for:
//     always, never   at every tick of the window, at none
//     within          at some tick of the window
//     after           each time that the condition `trigger` becomes true in the window, within
//                     `within_s`
//     detects         within `within_s` after the start of `fault` (its number in `faults`, from
//                     1; default: 1), and not just before; `monitor: NAME` is the condition that
//                     this monitor of the car reports a fault
//     until           at every tick from `from_s` to the first at which the condition `release`
//                     holds, at most `within_s` later
//     rate            at every tick of the window, of the absolute change of the signal per second
//                     over the last `over_s` (default: since the tick before)
//     quantile        of the quantile `quantile` of the signal over the window, by nearest rank
//   from_s, until_s   the window; default the whole run
//   rules of judgement: hil/grading/expectation.hpp and its judges
//   errors     thrown as yaml::InputError with the place, for read_scenario()
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hil/grading/expectation.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::scenario {

// Named by its place. `faults`: when each fault begins.
grading::Expectation read_expectation(yaml::StrictMap& map, std::span<const Instant> faults);

}  // namespace pitwall::scenario
