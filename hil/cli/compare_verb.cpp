// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/compare_verb.hpp"

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
#include "hil/nodes/can_variant.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

constexpr std::uint64_t kProgressEvery = 60 * 100;  // ticks: a minute of the run

struct CompareOptions {
  std::string recording, json_file;
  bench::RunFiles files;
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
      return Unexpected{Problem{"--tolerance " + text, "expected SIGNAL=VALUE, from 0"}};
    rules.tolerance[text.substr(0, equals)] = value;
  }
  return rules;
}

Result<bench::Comparison, Problem> compared(bench::RecordedRun& run, const pipeline::Setup& setup,
                                            bench::Comparison comparison) {
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
    if (comparison.ticks() % kProgressEvery == 0)
      std::fprintf(stderr, "%llu minutes of the run are driven again\n",
                   static_cast<unsigned long long>(comparison.ticks() / kProgressEvery));
  }
}

double seconds_in(const bench::Divergence& divergence, Instant begun) {
  return (divergence.at - begun).seconds();
}

void print(const bench::SignalDifference& d, Instant begun) {
  std::printf("%s: %llu values differ\n", d.signal.c_str(),
              static_cast<unsigned long long>(d.values));
  std::printf("  first    %9.2f s, tick %llu: recorded %.9g, now %.9g; %s\n",
              seconds_in(d.first, begun), static_cast<unsigned long long>(d.first.tick),
              d.first.recorded, d.first.again, d.context.c_str());
  std::printf("  largest  %9.2f s: recorded %.9g, now %.9g, by %.9g\n",
              seconds_in(d.largest, begun), d.largest.recorded, d.largest.again, d.largest.size());
}

std::string json_of(const bench::Divergence& d, Instant begun) {
  return json::Object{}
      .number("tick", d.tick)
      .number("at_s", seconds_in(d, begun))
      .number("recorded", d.recorded)
      .number("now", d.again)
      .str();
}

std::string json_of(const bench::Comparison& comparison, Instant begun) {
  json::Array differences;
  for (const bench::SignalDifference& d : comparison.differences())
    differences.json(json::Object{}
                         .text("signal", d.signal)
                         .number("values", d.values)
                         .json("first", json_of(d.first, begun))
                         .json("largest", json_of(d.largest, begun))
                         .text("context", d.context)
                         .str());
  return json::Object{}
      .number("ticks", comparison.ticks())
      .number("frames", comparison.frames())
      .number("values", comparison.values())
      .number("not_compared", comparison.measured().count())
      .json("differences", differences.str())
      .str();
}

int report(const bench::Comparison& comparison, Instant begun, const CompareOptions& options) {
  const auto differences = comparison.differences();
  for (const bench::SignalDifference& difference : differences) print(difference, begun);
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
  if (options.json_file.empty()) return code;
  const auto written = transport::write_file(options.json_file, json_of(comparison, begun) + "\n");
  return written ? code : refuse(written.error());
}

int compare(const CompareOptions& options) {
  auto rules = rules_of(options);
  if (!rules) return refuse(rules.error());
  auto run = bench::RecordedRun::open(options.recording);
  if (!run) return refuse(run.error());
  std::vector<std::string> remarks;
  const auto setup = bench::setup_of(*run, options.files, remarks);
  if (!setup) return refuse(setup.error());
  const auto variant = can_variant::CanVariant::of(scenario::BusRevision::kV14);
  if (!variant) return refuse(variant.error());
  const auto comparison =
      compared(*run, *setup, bench::Comparison{variant->database(), *std::move(rules)});
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
  app.option("RECORDING", options.recording, "folder of the black box, or a segment").required();
  app.option("--car", options.files.car, "car file; default: the one that the recording names");
  app.option("--track", options.files.track, "track file; likewise");
  app.option("--tolerance", options.tolerances,
             "SIGNAL=VALUE: such a difference is none; MESSAGE.SIGNAL or GROUP.FIELD");
  app.option("--ignore", options.ignored, "a signal, or a whole message or group");
  app.option("--json", options.json_file, "write the differences here");
  if (const auto code = app.ended_by(args)) return *code;
  return compare(options);
}

}  // namespace pitwall::cli
