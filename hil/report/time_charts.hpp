// Charts over time: states as rows, then speed, cross-track error, wall distance, controls, bus
// load and tyres, all on one time axis.
//   in     RunData
//   out    HTML: one plot per quantity, or a sentence that says why there is none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/report/run_data.hpp"

namespace pitwall::report {

inline constexpr double kPageWidth = 1200.0;  // pixels: 1280 minus margins and scroll bar

std::string time_charts(const RunData& run);

}  // namespace pitwall::report
