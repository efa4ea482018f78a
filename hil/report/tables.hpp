// Tables of a report: header, verdicts, figures, timing of every message, events, losses, condition
// of the log.
//   in     RunData
//   out    HTML; all text that comes from a file is escaped
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/report/run_data.hpp"

namespace pitwall::report {

std::string header(const RunData& run);
std::string banner(const RunData& run);  // the outcome in one line, the reasons below it
std::string verdict_table(const RunData& run);
std::string figures_table(const RunData& run);
std::string message_table(const RunData& run);     // regularity of each message
std::string real_time_charts(const RunData& run);  // for a live run
std::string event_table(const RunData& run);
std::string loss_table(const RunData& run);

}  // namespace pitwall::report
