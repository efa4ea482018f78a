// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/report_verb.hpp"

#include <cstdio>
#include <filesystem>

#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/report/junit.hpp"
#include "hil/report/page.hpp"
#include "hil/track_file/track_map_file.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

Result<world::TrackMap, Problem> load_track(const std::string& path) {
  if (path.empty()) return Unexpected{Problem{"the log", "names no track file"}};
  return track_file::read_track_map(path);
}

report::RunData load_run(const ReportFiles& files) {
  const auto log = transport::read_file(files.log);
  if (!log) {
    report::RunData run;
    run.infrastructure.push_back(to_string(log.error()));
    return run;
  }
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(log->data());
  report::RunData run = report::read_run({bytes, log->size()}, "event log");
  if (files.result.empty()) return run;
  if (const auto result = transport::read_file(files.result)) {
    report::add_result(run, *result, "result file");
  } else {
    run.infrastructure.push_back(to_string(result.error()));
  }
  return run;
}

int exit_code_of(report::Outcome outcome) {
  switch (outcome) {
    case report::Outcome::kPass:
      return kExitPass;
    case report::Outcome::kFail:
      return kExitFailed;
    case report::Outcome::kContact:
      return kExitContact;
    case report::Outcome::kInfrastructure:
      return kExitUnusable;
  }
  return kExitUnusable;
}

}  // namespace

int write_report(const ReportFiles& files, const std::optional<Problem>& failure) {
  report::RunData run = load_run(files);
  if (failure) run.infrastructure.insert(run.infrastructure.begin(), to_string(*failure));
  const auto track = load_track(files.track.empty() ? run.facts.track_file : files.track);
  // A track that somebody asked for must be there; one that the log names may be gone.
  if (!track && !files.track.empty()) return refuse(track.error());
  const std::string page = report::page(run, track ? &*track : nullptr,
                                        track ? std::string() : to_string(track.error()));
  const auto written = transport::write_file(files.html, page);
  if (!written) return refuse(written.error());
  if (!files.junit.empty()) {
    const auto junit = transport::write_file(files.junit, report::junit_xml(run));
    if (!junit) return refuse(junit.error());
  }
  for (const std::string& reason : run.infrastructure)
    std::fprintf(stderr, "pitwall-hil report: %s\n", reason.c_str());
  return exit_code_of(run.outcome());
}

ReportFiles report_files(const std::string& folder) {
  const auto in_folder = [&folder](const char* name) {
    return (std::filesystem::path(folder) / name).string();
  };
  return {.log = in_folder("events.mcap"),
          .html = in_folder("report.html"),
          .result = in_folder("run.json"),
          .junit = in_folder("junit.xml"),
          .track = {}};
}

std::optional<Problem> prepare_report(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const ReportFiles files = report_files(folder);
  for (const std::string& file : {files.log, files.html, files.result, files.junit})
    if (!error) std::filesystem::remove(file, error);
  return error ? std::optional{Problem{folder, error.message()}} : std::nullopt;
}

int report_verb(std::span<const std::string> args) {
  ReportFiles files;
  CommandLine app{"pitwall-hil report: the page and the JUnit file of a run"};
  app.option("log", files.log, "event log of the run (MCAP)").required();
  app.option("--out", files.html, "the page (HTML)").required();
  app.option("--result", files.result, "result of the same run (JSON)");
  app.option("--junit", files.junit, "write the verdicts as JUnit XML");
  app.option("--track", files.track, "track file, instead of the one that the log names");
  if (const auto code = app.ended_by(args)) return *code;
  return write_report(files, std::nullopt);
}

}  // namespace pitwall::cli
