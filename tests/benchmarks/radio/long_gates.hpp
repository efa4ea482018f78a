// Long form of the radio's gates: an hour of link for the budget, divided over its cases; half an
// hour per case and three seeds for the ages over fades.
//   in     share of these lengths: 1.0 is the whole
//   out    a line for each run as soon as it ends; whether all gates hold
//   cost   about a minute for the whole
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace pitwall::radio {

using SayLine = std::function<void(const std::string&)>;
bool run_long_gates(const SayLine& say, double share);

}  // namespace pitwall::radio
