// Tables of a report: header, verdicts, figures, timing of every message, events, losses, health of
// the log.
//   in     RunData
//   out    HTML; everything that came from a file is escaped
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/report/run_data.hpp"

namespace pitwall::report {

std::string header(const RunData& run);
std::string banner(const RunData& run);  // the outcome in one line, and what stands in its way
std::string verdict_table(const RunData& run);
std::string figures_table(const RunData& run);
std::string message_table(const RunData& run);     // how regularly each message came
std::string real_time_charts(const RunData& run);  // of a live run
std::string event_table(const RunData& run);
std::string loss_table(const RunData& run);

}  // namespace pitwall::report
