// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/compare_verb.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

#include "hil/bench/recorded/comparison.hpp"
#include "hil/bench/recorded/drive_again.hpp"
#include "hil/bench/recorded/recorded_run.hpp"
#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/recordings/compare_live.hpp"
#include "hil/cli/recordings/difference_text.hpp"
#include "hil/nodes/can_variant.hpp"
#include "hil/replay/reading/progress_line.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

constexpr std::uint64_t kProgressEvery = 100;  // ticks

struct CompareOptions {
  LiveComparison live;  // which recording and files; the rest where it is played to the car
  bool is_live = false, progress = false;
  std::vector<std::string> tolerances, ignored;
};

Result<bench::CompareRules, Problem> rules_of(const CompareOptions& options) {
  bench::CompareRules rules;
  rules.ignored.insert(options.ignored.begin(), options.ignored.end());
  for (const std::string& text : options.tolerances) {
    const std::size_t equals = text.find('=');
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const char* const start = text.data() + std::min(equals, text.size() - 1) + 1;
    const auto [stop, error] = std::from_chars(start, end, value);
    if (equals == std::string::npos || equals == 0 || error != std::errc{} || stop != end ||
        !(value >= 0.0) || std::isinf(value))
      return Unexpected{
          Problem{"--tolerance " + text, "expected SIGNAL=VALUE, with a value of at least 0"}};
    rules.tolerance[text.substr(0, equals)] = value;
  }
  return rules;
}

Result<bench::Comparison, Problem> compared(bench::RecordedRun& run, const pipeline::Setup& setup,
                                            bench::Comparison comparison,
                                            const replay::ReadProgress& reached) {
  bench::DriveAgain car{setup};
  while (true) {
    const auto tick = run.next();
    if (!tick) return Unexpected{tick.error()};
    if (!*tick) return comparison;
    const auto again = car.tick(**tick);
    if (!again) {
      const std::string number = std::to_string((*tick)->given.number);
      return Unexpected{Problem{"tick " + number + ": " + again.error().place, again.error().what}};
    }
    comparison.add(**tick, *again, car.measured());
    if (reached && comparison.ticks() % kProgressEvery == 0) reached(run.done(), run.size());
  }
}

std::string json_of(const bench::Comparison& comparison, Instant begun) {
  return json::Object{}
      .number("ticks", comparison.ticks())
      .number("frames", comparison.frames())
      .number("values", comparison.values())
      .number("not_compared", comparison.measured().count())
      .json("differences", differences_json(comparison.differences(), begun))
      .str();
}

int report(const bench::Comparison& comparison, Instant begun, const CompareOptions& options) {
  const auto differences = comparison.differences();
  std::printf("%s", differences_text(differences, begun).c_str());
  for (const std::string& rule : comparison.unused_rules())
    std::fprintf(stderr, "%s: no value differs there: the rule does nothing\n", rule.c_str());
  std::printf(
      "%llu ticks driven again, %llu frames and %llu values compared: %zu signals differ\n"
      "not compared: %zu fields that the process measures of itself\n",
      static_cast<unsigned long long>(comparison.ticks()),
      static_cast<unsigned long long>(comparison.frames()),
      static_cast<unsigned long long>(comparison.values()), differences.size(),
      comparison.measured().count());
  const int code = differences.empty() ? kExitPass : kExitFailed;
  if (options.live.json_file.empty()) return code;
  const auto written =
      transport::write_file(options.live.json_file, json_of(comparison, begun) + "\n");
  return written ? code : refuse(written.error());
}

int compare(const CompareOptions& options) {
  auto rules = rules_of(options);
  if (!rules) return refuse(rules.error());
  auto run = bench::RecordedRun::open(options.live.recording);
  if (!run) return refuse(run.error());
  std::vector<std::string> remarks;
  const auto setup = bench::setup_of(*run, options.live.files, remarks);
  if (!setup) return refuse(setup.error());
  const auto variant = can_variant::CanVariant::of(scenario::BusRevision::kV14);
  if (!variant) return refuse(variant.error());
  const auto comparison = [&] {
    replay::ProgressLine line("driving " + options.live.recording + " again", options.progress);
    return compared(*run, *setup, bench::Comparison{variant->database(), *std::move(rules)},
                    line.function());
  }();
  if (!comparison) return refuse(comparison.error());
  remarks.insert(remarks.end(), run->remarks().begin(), run->remarks().end());
  for (const std::string& remark : remarks) std::fprintf(stderr, "%s\n", remark.c_str());
  return report(*comparison, run->begun(), options);
}

}  // namespace

int compare_verb(std::span<const std::string> args) {
  CompareOptions options;
  CommandLine app{
      "pitwall-hil compare: a car's own recording (pitwall-vehicle --record) driven again by this "
      "build; exit 0 it says the same, 1 something else, 2 unusable"};
  LiveComparison& live = options.live;
  app.option("RECORDING", live.recording, "folder of the black box, or a segment").required();
  app.option("--car", live.files.car, "car file; default: the one that the recording names");
  app.option("--track", live.files.track, "track file; likewise");
  const VerbOption tolerance =
      app.option("--tolerance", options.tolerances,
                 "SIGNAL=VALUE: such a difference is none; MESSAGE.SIGNAL or GROUP.FIELD");
  const VerbOption ignored =
      app.option("--ignore", options.ignored, "a signal, or a whole message or group");
  app.option("--json", live.json_file, "write the differences here");
  const VerbOption progress = app.flag("--progress", options.progress, replay::kProgressHelp);
  VerbOption is_live =
      app.flag("--live", options.is_live,
               "play the recording to pitwall-vehicle over a bus and its receivers' ports, and "
               "compare modes and commands within tolerances");
  is_live.excludes(tolerance).excludes(ignored).excludes(progress);
  app.option("--interface", live.interface, "live: CAN interface, or unix:PATH").needs(is_live);
  app.option("--out", live.folder,
             "live: folder for the car's new recording, in a folder of its time, and its summary; "
             "default " +
                 live.folder)
      .needs(is_live);
  app.option("--clock", live.clock,
             "live: bench (its time stands while the machine holds a process up; the default) or "
             "wall")
      .needs(is_live);
  if (const auto code = app.ended_by(args)) return *code;
  return options.is_live ? compare_live(live) : compare(options);
}

}  // namespace pitwall::cli
