// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/compare_live.hpp"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "hil/bench/live/run_keys.hpp"
#include "hil/bench/recorded/command_comparison.hpp"
#include "hil/bench/recorded/live_replay.hpp"
#include "hil/can_bus/own_hub.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/live/clock_place.hpp"
#include "hil/cli/live/programs.hpp"
#include "hil/cli/recordings/difference_text.hpp"
#include "hil/cli/recordings/recording_folder.hpp"
#include "hil/nodes/can_variant.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {
namespace {

namespace fs = std::filesystem;

// What is known of the recorded run before anything is started.
struct Recorded {
  bench::RunFiles files;
  bool has_base = false;  // its car watched one
  bench::CommandTrace trace;
  bench::CommandTolerances tolerances;
  std::vector<std::string> remarks;
};

struct LiveResult {
  bench::PlayedRun played;
  bench::CommandTrace trace;
};

Result<Recorded, Problem> read_recorded(const LiveComparison& options,
                                        const can::Database& database) {
  auto run = bench::RecordedRun::open(options.recording);
  if (!run) return Unexpected{run.error()};
  Recorded out;
  out.files = bench::files_of(*run, options.files);
  const auto setup = bench::setup_of(*run, out.files, out.remarks);
  if (!setup) return Unexpected{setup.error()};
  out.has_base = bench::has_base(*run);
  auto trace = bench::trace_of(*run, database);
  if (!trace) return Unexpected{trace.error()};
  out.trace = *std::move(trace);
  out.tolerances = bench::tolerances_of(setup->params, database);
  out.remarks.insert(out.remarks.end(), run->remarks().begin(), run->remarks().end());
  const auto remark = [&](std::uint64_t ticks, const char* what) {
    if (ticks > 0) out.remarks.push_back(what + (": " + std::to_string(ticks)) + " ticks");
  };
  remark(out.trace.others.guardian, "not played: the guardian drove, or had stopped the car");
  remark(out.trace.others.controller, "not played: trouble of the CAN controller, or lost frames");
  remark(out.trace.others.joystick, "not played: the joystick");
  remark(out.trace.others.silence, "not played: silence of the base station");
  return out;
}

// A folder that is not there yet: a recording of before would be part of the new one.
std::string new_folder(const std::string& parent) {
  for (int number = 1;; ++number) {
    std::string folder = parent + "/record-" + std::to_string(number);
    std::error_code none;
    if (!fs::exists(folder, none)) return folder;
  }
}

bench::LivePlan plan_of(const LiveComparison& options, const Recorded& recorded,
                        const std::string& record, const ClockPlace& clock) {
  const bench::RunFiles& files = recorded.files;
  bench::LivePlan plan{.interface = options.interface,
                       .vehicle = {beside("vehicle/pitwall-vehicle"), "--car", files.car, "--track",
                                   files.track, "--record", record},
                       .folder = options.folder,
                       .clock = clock.file,
                       .clock_line = clock.line};
  if (!recorded.has_base) return plan;
  plan.base = {beside("basestation/pitwall-base")};
  plan.has_operator = true;
  return plan;
}

Result<LiveResult, Problem> play(const LiveComparison& options, const Recorded& recorded,
                                 const can::Database& database, const ClockPlace& clock) {
  auto traffic = read_traffic(options.recording);
  if (!traffic) return Unexpected{traffic.error()};
  const auto hub = can_bus::OwnHub::start(own_program(), options.interface, clock.file);
  if (!hub) return Unexpected{hub.error()};
  const std::string record = new_folder(options.folder);
  bench::LivePlan plan = plan_of(options, recorded, record, clock);
  std::optional<bench::RunKeys> keys;  // as long as the run
  if (plan.has_base()) {
    auto made = bench::keys_of_run(plan, "");
    if (!made) return Unexpected{made.error()};
    plan.keys = keys.emplace(*std::move(made)).folder;
  }
  auto played = bench::play_to_car(*std::move(traffic), recorded.trace, plan);
  if (!played) return Unexpected{played.error()};
  auto run = bench::RecordedRun::open(record);
  if (!run) return Unexpected{run.error()};
  auto trace = bench::trace_of(*run, database);
  if (!trace) return Unexpected{trace.error()};
  return LiveResult{*std::move(played), *std::move(trace)};
}

std::string tolerances_text(const bench::CommandTolerances& tolerances) {
  std::string text = formatted("tolerances: %.0f ms", tolerances.command_lag().milliseconds());
  for (std::size_t i = 0; i < bench::kActuators; ++i)
    text += formatted(", %s %.6g", bench::kCommandSignals[i].signal.data(), tolerances.command[i]);
  return text + formatted(", modes %.0f ms\n", tolerances.mode_lag().milliseconds());
}

std::string played_text(const LiveResult& live) {
  const replay::PlayReport& report = live.played.report;
  std::string text =
      formatted("played %llu frames and %llu datagrams to the car, %llu dropped, late p99 %.2f ms",
                static_cast<unsigned long long>(report.frames.sent),
                static_cast<unsigned long long>(report.datagrams.sent),
                static_cast<unsigned long long>(report.dropped()),
                report.lateness.quantile(0.99).milliseconds());
  if (const auto& waits = live.played.waits)
    text += formatted("; bench time stood %.1f s", waits->total.seconds());
  return text + "\n";
}

std::string json_of(const bench::CommandComparison& comparison, const LiveResult& live) {
  return json::Object{}
      .number("ticks", live.trace.ticks)
      .number("commands", comparison.commands)
      .number("modes", comparison.modes)
      .number("compared_s", comparison.compared.seconds())
      .number("played_frames", live.played.report.frames.sent)
      .number("played_datagrams", live.played.report.datagrams.sent)
      .number("not_played", live.played.report.dropped())
      .json("differences", differences_json(comparison.differences, Instant{}))
      .str();
}

int report(const Recorded& recorded, const LiveResult& live, const LiveComparison& options) {
  const bench::CommandComparison comparison =
      bench::compare(recorded.trace, live.trace, recorded.tolerances);
  std::printf("%s%s%s", played_text(live).c_str(), tolerances_text(recorded.tolerances).c_str(),
              differences_text(comparison.differences, Instant{}).c_str());
  std::printf("%.2f s of the run, %llu modes and %llu commands compared: %zu signals differ\n",
              comparison.compared.seconds(), static_cast<unsigned long long>(comparison.modes),
              static_cast<unsigned long long>(comparison.commands), comparison.differences.size());
  if (!options.json_file.empty()) {
    const auto written = transport::write_file(options.json_file, json_of(comparison, live) + "\n");
    if (!written) return refuse(written.error());
  }
  return comparison.differences.empty() ? kExitPass : kExitFailed;
}

}  // namespace

int compare_live(const LiveComparison& options) {
  const auto variant = can_variant::CanVariant::of(scenario::BusRevision::kV14);
  if (!variant) return refuse(variant.error());
  const auto recorded = read_recorded(options, variant->database());
  if (!recorded) return refuse(recorded.error());
  for (const std::string& remark : recorded->remarks) std::fprintf(stderr, "%s\n", remark.c_str());
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (error) return refuse({options.folder, error.message()});
  const ClockPlace clock = clock_place(options.clock, false);
  if (!clock.file.empty()) {
    if (const auto used = transport::use_clock(clock.file); !used) return refuse(used.error());
  }
  const auto live = play(options, *recorded, variant->database(), clock);
  if (clock.is_own) fs::remove(clock.file, error);
  if (!live) return refuse(live.error());
  return report(*recorded, *live, options);
}

}  // namespace pitwall::cli
