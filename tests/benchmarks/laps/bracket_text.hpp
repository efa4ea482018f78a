// Names and figures of the speed brackets, as tables and JSON of the benchmarks print them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/grading/cross_track.hpp"

namespace pitwall::laps {

std::string bracket_name(const grading::Bracket& bracket);  // "55-60", or ">60"

// JSON array of lower edge, samples, mean and maximum of each bracket.
std::string brackets_json(const grading::CrossTrack& cross_track);

}  // namespace pitwall::laps
