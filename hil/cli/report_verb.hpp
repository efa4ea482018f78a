// Subcommand `pitwall-hil report EVENTS.mcap --out report.html [--result run.json] [--junit FILE]
//                                [--track FILE]`
// Makes the HTML page and the JUnit file of a run from its event log, after the run or later.
//   in     the event log; the result of the same run, for laps, traffic and real-time figures; the
//          track for the walls of the map (default: the file that the log names, if it exists)
//   out    both files, also for a log that is cut, damaged or missing: the files then state that
//   errors exit code 0: every expectation passed; 1: one failed; 2: wrong usage, an unreliable log
//          or result, a file that cannot be written
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

struct ReportFiles {
  std::string log, html;
  std::string result, junit, track;  // empty: none
};

// `failure`: why the run did not end properly, if so. Returns the exit code as above.
int write_report(const ReportFiles& files, const std::optional<Problem>& failure);

// Output files of `run --report FOLDER`: events.mcap, run.json, report.html, junit.xml.
ReportFiles report_files(const std::string& folder);
// Creates the folder and removes the files of an earlier run in it.
std::optional<Problem> prepare_report(const std::string& folder);

int report_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
