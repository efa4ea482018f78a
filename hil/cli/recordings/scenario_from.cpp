// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/scenario_from.hpp"

#include <cstdio>
#include <vector>

#include "hil/bench/recorded/recorded_scenario.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

Result<std::string, Problem> made_of(const ScenarioFromOptions& options) {
  auto run = bench::RecordedRun::open(options.recording);
  if (!run) return Unexpected{run.error()};
  std::vector<std::string> remarks;
  const bench::ScenarioSource source{options.recording, bench::files_of(*run, options.files)};
  const auto setup = bench::setup_of(*run, source.files, remarks);
  if (!setup) return Unexpected{setup.error()};
  const auto facts = bench::facts_of(*run, *setup);
  if (!facts) return Unexpected{facts.error()};
  remarks.insert(remarks.end(), run->remarks().begin(), run->remarks().end());
  for (const std::string& remark : remarks) std::fprintf(stderr, "%s\n", remark.c_str());
  std::string text = bench::scenario_text(*facts, source);
  // A run that is too short or too long for a scenario is told here, and not when it is driven.
  const auto read = scenario::read_scenario(text, options.recording + " as a scenario");
  if (!read) return Unexpected{read.error()};
  return text;
}

}  // namespace

void add_options(CommandLine& verb, ScenarioFromOptions& options) {
  verb.option("RECORDING", options.recording, "folder of the black box, or a segment").required();
  verb.option("--car", options.files.car, "car file; default: the one that the recording names");
  verb.option("--track", options.files.track, "track file; likewise");
  verb.option("--out", options.out_file, "write it here; default: standard output");
}

int scenario_from(const ScenarioFromOptions& options) {
  const auto text = made_of(options);
  if (!text) return refuse(text.error());
  if (options.out_file.empty()) {
    std::fputs(text->c_str(), stdout);
    return kExitPass;
  }
  const auto written = transport::write_file(options.out_file, *text);
  return written ? kExitPass : refuse(written.error());
}

}  // namespace pitwall::cli
