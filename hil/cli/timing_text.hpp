// Text about the timing of a live run.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/bench/live/live.hpp"
#include "hil/bench/result.hpp"

namespace pitwall::cli {

std::string timing_text(const bench::LiveResult& live);
// What the host of a virtual machine took; empty where it took nothing, and in a guest, whose bench
// cannot know it.
// For how long bench time stood, and for whom.
std::string waits_text(const bench::RealTime& time);
std::string stolen_text(const bench::RealTime& time);
// Why the run has judged nothing.
std::string late_text(const bench::RealTime& time);

}  // namespace pitwall::cli
