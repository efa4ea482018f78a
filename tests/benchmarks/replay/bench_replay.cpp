// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/bench_replay.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "hil/can_bus/bus_verb.hpp"
#include "hil/cli/live/programs.hpp"
#include "hil/replay/formats/candump.hpp"
#include "hil/replay/timeline.hpp"
#include "hil/replay/writers/candump_writer.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/replay/match_report.hpp"
#include "tests/benchmarks/replay/player_match.hpp"
#include "tests/benchmarks/replay/sample_log.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr double kMaxLength_s = 600.0;
constexpr double kOverhead_s = 20.0;  // a run's start, end and recording, on a busy machine

struct BenchOptions {
  std::string log_file, json_file, folder, interface = "vcan0", host_load;
  double length_s = 10.0;
  int runs = 3;
  bool here = false;
};

std::string host_load() {
  const std::string text = transport::read_file("/proc/loadavg").value_or("");
  std::size_t end = 0;
  for (int field = 0; field < 3 && end != std::string::npos; ++field) end = text.find(' ', end + 1);
  return text.substr(0, end);
}

// The other players refuse a log with a bad line, or play it otherwise.
Result<replay::CanLog, Problem> read_whole(std::string_view text, const std::string& file) {
  auto log = replay::read_candump(text, file);
  if (!log || log->remarks.empty()) return log;
  return Unexpected{Problem{log->remarks[0].place, log->remarks[0].what}};
}

// What is measured must be the schedule of one log on one bus; the parser and the timeline refuse
// what no player could play.
Result<double, Problem> length_of(const std::string& file, replay::CanLog& log) {
  const auto text = transport::read_file(file);
  if (!text) return Unexpected{text.error()};
  auto parsed = read_whole(*text, file);
  if (!parsed) return Unexpected{parsed.error()};
  const auto timeline = replay::make_timeline(*parsed, {.interface = "any"});
  if (!timeline) return Unexpected{timeline.error()};
  log = *std::move(parsed);
  return timeline->pass.seconds();
}

int match_here(const BenchOptions& options) {
  replay::CanLog log;
  const auto length_s = length_of(options.log_file, log);
  if (!length_s) return refuse(length_s.error());
  auto figures = play_match({.log_file = options.log_file,
                             .folder = options.folder,
                             .interface = options.interface,
                             .runs = options.runs},
                            log);
  if (!figures) return refuse(figures.error());
  const MatchReport report{.frames = log.frames.size(),
                           .length_s = *length_s,
                           .host_load = options.host_load,
                           .figures = *std::move(figures)};
  std::printf("%s", to_text(report).c_str());
  std::fflush(stdout);
  if (!options.json_file.empty()) {
    const auto written = transport::write_file(options.json_file, to_json(report));
    if (!written) return refuse(written.error());
  }
  const auto gates = gates_of(report.figures);
  const bool held =
      std::all_of(gates.begin(), gates.end(), [](const MatchGate& gate) { return gate.held(); });
  return held ? kExitPass : kExitFailed;
}

std::vector<std::string> exec_command(const BenchOptions& options, const std::string& folder,
                                      double length_s) {
  const double passes = static_cast<double>(kPlayers) - 1.0 + kSensorPasses;  // of all players
  const double most_s = kOverhead_s + options.runs * (passes * length_s +
                                                      static_cast<double>(kPlayers) * kOverhead_s);
  std::vector<std::string> out{"exec",        "--auto",
                               "--interface", options.interface,
                               "--timeout",   std::to_string(static_cast<int>(most_s)),
                               "--",          cli::own_program(),
                               "replay",      "--here",
                               "--log",       folder + "/played.log",
                               "--folder",    folder,
                               "--interface", options.interface,
                               "--runs",      std::to_string(options.runs),
                               "--host-load", host_load()};
  if (!options.json_file.empty()) {
    out.emplace_back("--json");
    out.push_back(options.json_file);
  }
  return out;
}

// The log becomes a file that every player can read, wherever the bus is; bad input is told before
// a machine is booted for it.
int match_where_can_is(const BenchOptions& options) {
  const auto folder = transport::TemporaryFolder::create("pitwall-bench-replay-");
  if (!folder) return refuse(folder.error());
  const std::string file = folder->path() + "/played.log";
  std::string text;
  if (options.log_file.empty()) {
    text = replay::to_candump(replay::sample_log(from_seconds(options.length_s)));
  } else {
    const auto read = transport::read_file(options.log_file);
    if (!read) return refuse(read.error());
    text = *read;
    if (const auto log = read_whole(text, options.log_file); !log) return refuse(log.error());
  }
  if (const auto written = transport::write_file(file, text); !written)
    return refuse(written.error());
  replay::CanLog log;
  const auto length_s = length_of(file, log);
  if (!length_s) return refuse(length_s.error());
  if (*length_s > kMaxLength_s) return refuse({options.log_file, "is longer than ten minutes"});
  return can_bus::bus_verb(exec_command(options, folder->path(), *length_s));
}

}  // namespace

int bench_replay(std::span<const std::string> args) {
  BenchOptions options;
  CommandLine app{"pitwall-benchmarks replay: replay timing beside canplayer and python-can"};
  app.option("--log", options.log_file, "candump log to play");
  app.option("--length", options.length_s, "seconds of the default log").range(1.0, kMaxLength_s);
  app.option("--runs", options.runs, "of each player").range(1, 100);
  app.option("--interface", options.interface, "CAN interface");
  app.option("--json", options.json_file, "write the figures here");
  app.flag("--here", options.here, "the interface exists here already").hidden();
  app.option("--folder", options.folder, "for what is written on the way").hidden();
  app.option("--host-load", options.host_load, "to be reported").hidden();
  if (const auto code = app.ended_by(args)) return *code;
  return options.here ? match_here(options) : match_where_can_is(options);
}

}  // namespace pitwall::benchmarks
