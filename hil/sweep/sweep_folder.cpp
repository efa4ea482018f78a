// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/sweep_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <string_view>
#include <utility>

#include "hil/sweep/results_file.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::sweep {
namespace {

namespace fs = std::filesystem;

// Written at the first time; then it has to be the same.
Result<bool, Problem> keep(const std::string& file, const std::string& text) {
  if (!fs::exists(file)) return transport::write_file(file, text);
  const auto kept = transport::read_file(file);
  if (!kept) return Unexpected{kept.error()};
  if (*kept == text) return true;
  return refuse(file, "is another one than that of this sweep: take another folder for it");
}

void read_lines(std::string_view text, std::size_t cases, std::vector<CaseResult>& results) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return;  // the process died in the middle of the line
    auto result = parse_case_result(text.substr(0, end));
    if (result && result->number < cases) results.push_back(*std::move(result));
    text.remove_prefix(end + 1);
  }
}

// By number; of two of one case the one that is no crash.
std::vector<CaseResult> in_order(std::vector<CaseResult> results) {
  std::ranges::stable_sort(results, {}, [](const CaseResult& result) {
    return std::pair{result.number, result.verdict == CaseVerdict::kCrashed};
  });
  const auto twice = std::ranges::unique(results, {}, &CaseResult::number);
  results.erase(twice.begin(), twice.end());
  return results;
}

}  // namespace

Result<SweepFolder, Problem> SweepFolder::open(const std::string& path,
                                               const std::string& plan_text,
                                               const std::string& scenario_text) {
  std::error_code error;
  fs::create_directories(path + "/cases", error);
  if (error) return refuse(path, error.message());
  auto kept = keep(path + "/plan.yaml", plan_text);
  if (kept) kept = keep(path + "/scenario.yaml", scenario_text);
  SweepFolder folder{path};
  if (kept) kept = check_results(folder.results_file());
  if (!kept) return Unexpected{kept.error()};
  return folder;
}

Result<bool, Problem> SweepFolder::append(const std::string& name, const CaseResult& result) const {
  const std::string file = file_of(name);
  auto writer = transport::AppendWriter::open(file);
  if (!writer) return Unexpected{writer.error()};
  if (!writer->write(to_line(result) + "\n")) return refuse(file, "no room for a result");
  return true;
}

Result<std::vector<CaseResult>, Problem> SweepFolder::read(std::size_t cases) const {
  std::vector<CaseResult> results;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_ + "/cases", error)) {
    const auto text = transport::read_file(entry.path().string());
    if (!text) return Unexpected{text.error()};
    read_lines(*text, cases, results);
  }
  if (error) return refuse(path_, error.message());
  return in_order(std::move(results));
}

Result<std::vector<CaseResult>, Problem> SweepFolder::read_of(const std::string& name,
                                                              std::size_t cases) const {
  std::vector<CaseResult> results;
  if (!fs::exists(file_of(name))) return results;
  const auto text = transport::read_file(file_of(name));
  if (!text) return Unexpected{text.error()};
  read_lines(*text, cases, results);
  return in_order(std::move(results));
}

CaseNumbers without_result(const CaseNumbers& numbers, const std::vector<CaseResult>& results) {
  CaseNumbers left;
  for (const std::size_t number : numbers)
    if (!std::ranges::binary_search(results, number, {}, &CaseResult::number))
      left.push_back(number);
  return left;
}

CaseNumbers missing_cases(const std::vector<CaseResult>& results, std::size_t cases) {
  CaseNumbers all(cases);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return without_result(all, results);
}

}  // namespace pitwall::sweep
