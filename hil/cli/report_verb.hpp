// `pitwall-hil report EVENTS.mcap --out report.html [--result run.json] [--junit FILE]
//                                [--track FILE]`
// The page and the JUnit file of a run, made from its event log, now or later.
//   in     the event log; the result of the same run, for laps, traffic and real-time figures; the
//          track for the walls of the map (default: the file that the log names, where it is there)
//   out    both files, also for a log that is cut, damaged or missing: then they say so
//   errors exit code 0: every expectation held; 1: one did not; 2: wrong usage, a log or result
//          that cannot be relied on, a file that cannot be written
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

// `failure`: why the run itself did not end, where it did not. The exit code as above.
int write_report(const ReportFiles& files, const std::optional<Problem>& failure);

// Where `run --report FOLDER` leaves its files: events.mcap, run.json, report.html, junit.xml.
ReportFiles report_files(const std::string& folder);
// Makes the folder and takes away what another run left there.
std::optional<Problem> prepare_report(const std::string& folder);

int report_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
