// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/sweep/case_pages.hpp"

#include <filesystem>
#include <optional>

#include "hil/cli/report_verb.hpp"
#include "hil/sweep/in_parallel.hpp"
#include "protocol/json/json_value.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"

namespace pitwall::cli {
namespace {

namespace fs = std::filesystem;

class CasePage {
 public:
  CasePage(const sweep::CaseResult& result, const PagesPlan& plan)
      : result_(result), plan_(plan), files_(report_files(folder())) {}

  Result<bool, Problem> make() const {
    if (has_same_run() && fs::exists(files_.html)) return true;
    if (const auto ran = run(); !ran) return ran;
    if (has_same_run()) return true;
    if (!fs::exists(files_.result)) return refuse(words_file(), "the case left no result");
    return refuse(folder(), "this build makes another run of case " +
                                std::to_string(result_.number) +
                                " than the sweep has: run the sweep again, in another folder");
  }

 private:
  std::string folder() const { return plan_.folder + "/" + std::to_string(result_.number); }

  std::string words_file() const { return folder() + "/run.txt"; }  // what the run prints

  Result<bool, Problem> run() const {
    std::error_code error;
    fs::create_directories(folder(), error);
    if (error) return refuse(folder(), error.message());
    std::vector<std::string> argv{"sh", "-c", "exec \"$@\" > \"$0\" 2>&1", words_file()};
    argv.insert(argv.end(), plan_.command.begin(), plan_.command.end());
    argv.insert(argv.end(), {"--case", std::to_string(result_.number), "--report", folder()});
    auto process = transport::Process::spawn({.argv = argv});
    if (!process) return Unexpected{process.error()};
    process->wait();
    return true;
  }

  bool has_same_run() const {
    const auto text = transport::read_file(files_.result);
    if (!text) return false;
    const auto json = json::JsonValue::parse(*text, files_.result);
    return json && json->text("sha256") == result_.digest;
  }

  const sweep::CaseResult& result_;
  const PagesPlan& plan_;
  ReportFiles files_;
};

}  // namespace

Result<CasePages, Problem> make_case_pages(const std::vector<const sweep::CaseResult*>& cases,
                                           const PagesPlan& plan) {
  std::vector<const sweep::CaseResult*> runs;
  for (const sweep::CaseResult* of : cases)
    if (!of->digest.empty()) runs.push_back(of);
  std::vector<std::optional<Problem>> problems(runs.size());
  sweep::in_parallel(runs.size(), plan.processes, [&](std::size_t i) {
    if (const auto made = CasePage{*runs[i], plan}.make(); !made) problems[i] = made.error();
  });
  for (const std::optional<Problem>& problem : problems)
    if (problem) return Unexpected{*problem};
  CasePages pages;
  for (const sweep::CaseResult* of : runs)
    pages[of->number] = "pages/" + std::to_string(of->number) + "/report.html";
  return pages;
}

}  // namespace pitwall::cli
