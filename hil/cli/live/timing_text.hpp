// Text about the timing of a live run, for its report.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/bench/live/live.hpp"
#include "hil/bench/result.hpp"

namespace pitwall::cli {

std::string timing_text(const bench::LiveResult& live);
// Its last part, of one car: local reports and datagrams of the radio.
std::string reports_text(const bench::LiveResult& live);
// waits_text(): total pause of bench time and the process that caused the longest. stolen_text():
// processor time that the host of a virtual machine took; empty if none, and in a guest, where it
// cannot be measured.
std::string waits_text(const bench::RealTime& time);
std::string stolen_text(const bench::RealTime& time);

}  // namespace pitwall::cli
