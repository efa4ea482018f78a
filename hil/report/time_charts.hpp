// Charts over time: states as lanes, then speed, cross-track error, wall, controls, load of the bus
// and tyres, all on one time axis.
//   in     RunData
//   out    HTML: one plot per quantity, or the sentence why there is none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/report/run_data.hpp"

namespace pitwall::report {

inline constexpr double kPageWidth = 1200.0;  // of everything; 1280 less margins and scroll bar

std::string time_charts(const RunData& run);

}  // namespace pitwall::report
