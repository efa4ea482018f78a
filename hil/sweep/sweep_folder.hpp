// Folder of a sweep: its plan and scenario as they were when it began, and a file of results of
// each process that worked on it. Several processes, on several machines, may write at once.
//   format plan.yaml, scenario.yaml; cases/NAME.jsonl (case_result.hpp); at the end results.sqlite,
//          report.html, summary.json (summary.hpp), and pages/NUMBER with the report of that case
//   errors open(): Problem if the folder has another plan or scenario, or results of another schema
//          (results_file.hpp), or cannot be made
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hil/sweep/case_result.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::sweep {

class SweepFolder {
 public:
  // Made where it does not exist.
  static Result<SweepFolder, Problem> open(const std::string& path, const std::string& plan_text,
                                           const std::string& scenario_text);

  const std::string& path() const { return path_; }
  std::string results_file() const { return path_ + "/results.sqlite"; }
  std::string report_file() const { return path_ + "/report.html"; }
  std::string summary_file() const { return path_ + "/summary.json"; }
  std::string pages_folder() const { return path_ + "/pages"; }
  // Appends to the file of a process of that name.
  Result<bool, Problem> append(const std::string& name, const CaseResult& result) const;
  // Of all processes, by number; of two of one case the one that is no crash. Lines that are cut
  // short or of no case below `cases` are left out.
  Result<std::vector<CaseResult>, Problem> read(std::size_t cases) const;
  // Of the process of that name alone; none where it has written nothing.
  Result<std::vector<CaseResult>, Problem> read_of(const std::string& name,
                                                   std::size_t cases) const;

 private:
  explicit SweepFolder(std::string path) : path_(std::move(path)) {}
  std::string file_of(const std::string& name) const { return path_ + "/cases/" + name + ".jsonl"; }

  std::string path_;
};

using CaseNumbers = std::vector<std::size_t>;

// Those of the numbers that have no result; `results` in order.
CaseNumbers without_result(const CaseNumbers& numbers, const std::vector<CaseResult>& results);
// Numbers below `cases` that have no result; `results` in order.
CaseNumbers missing_cases(const std::vector<CaseResult>& results, std::size_t cases);

}  // namespace pitwall::sweep
