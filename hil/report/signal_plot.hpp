// Plot of CAN signals over time: one panel per unit, as an SVG file or as an HTML page.
//   in     series, the part of the time axis to draw, the lines of the caption
//   out    one file without external references. The script of the page only adds the read-out
//          under the pointer
//   invariants
//          signals of one unit share a panel, up to kPanelSignals of them with comparable ranges. A
//          signal whose every value has a name has a panel of its own, with steps and these names.
//          A series without values has no panel. The same input gives the same bytes
//   units  seconds from the start of the log; values in the units of the database
//   errors none: names are escaped, whatever their bytes are
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hil/report/signal_series.hpp"

namespace pitwall::report {

inline constexpr std::size_t kPanelSignals = 4;
inline constexpr double kLeastDrawn_s = 1e-3;  // shortest time axis

struct SignalPlot {
  std::string title;
  std::vector<std::string> caption;
  std::span<const SignalSeries> series;
  double from_s = 0.0, to_s = kLeastDrawn_s;  // at least kLeastDrawn_s apart
};

std::string signal_svg(const SignalPlot& picture);
std::string signal_page(const SignalPlot& picture);

}  // namespace pitwall::report
