// Text of a field's value in gates and checklist.
//   in     a value, NaN if it is not known; its unit, or the labels of its field
//   out    "12.3 m/s"; a label; "no data"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace pitwall::command {

std::string number(double value, const char* unit);
std::string label(std::string_view labels, double value);

}  // namespace pitwall::command
