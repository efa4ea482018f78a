// Long form of the radio's gates: an hour of link for the budget, divided over its cases, and
// half an hour with changes of the keys; half an hour per case and seed for the ages over fades,
// with three seeds.
//   in     share of these lengths: 1.0 is the whole
//   out    a line for each run as soon as it ends; whether all gates hold
//   cost   about a minute for the whole
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace pitwall::radio {

using PrintLine = std::function<void(const std::string&)>;
bool run_long_gates(const PrintLine& print, double share);

}  // namespace pitwall::radio
