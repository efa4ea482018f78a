// The long form of the radio's gates: an hour of link for the budget, half an hour and three seeds
// for the ages over fades.
//   in     of each of both, how much: 1.0 is the whole
//   out    a line for each run as soon as it ended; whether all held
//   cost   about a minute for the whole
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace pitwall::radio {

using SayLine = std::function<void(const std::string&)>;
bool run_long_gates(const SayLine& say, double share);

}  // namespace pitwall::radio
