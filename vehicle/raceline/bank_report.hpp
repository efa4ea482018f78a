// Report of a bank of racelines: the figures of each line's check, for people and for programs.
//   in     the figures of check_raceline(), one for each line
//   out    a table as text; one JSON object
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "vehicle/raceline/lanes/raceline.hpp"
#include "vehicle/raceline/line_check.hpp"

namespace pitwall::raceline {

std::string report_text(const RacelineBank& bank, std::span<const LineFigures> figures);
std::string report_json(const RacelineBank& bank, std::span<const LineFigures> figures);

}  // namespace pitwall::raceline
