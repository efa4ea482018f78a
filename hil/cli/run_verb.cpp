// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/run_verb.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "hil/bench/live/live_plan.hpp"
#include "hil/bench/live/virtual_machine.hpp"
#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/can_bus/bus_options.hpp"
#include "hil/can_bus/bus_verb.hpp"
#include "hil/can_bus/own_hub.hpp"
#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/live/car_plans.hpp"
#include "hil/cli/live/clock_place.hpp"
#include "hil/cli/live/live_run.hpp"
#include "hil/cli/live/programs.hpp"
#include "hil/cli/report_verb.hpp"
#include "protocol/transport/can/unix_bus.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall::cli {
namespace {

namespace fs = std::filesystem;

// The bench's ends of a line out of a guest; without a guest they are ports of this machine.
constexpr std::uint16_t kLineRadioPort = 23'427, kLineUplinkPort = 23'428;

Result<bench::RunResult, Problem> lockstep(const RunOptions& options, const bench::Loaded& loaded,
                                           const bench::Follow& follow) {
  const auto log = sink_to(options.log_file);
  if (!log) return Unexpected{log.error()};
  std::vector<recording::Sink> other_logs;
  for (const bench::LoadedStack& other : loaded.stacks) {
    const auto of_other = sink_to(file_of(other.name, options.log_file));
    if (!of_other) return Unexpected{of_other.error()};
    other_logs.push_back(*of_other);
  }
  const Instant begun = transport::monotonic_now();
  // Without a file the log is still made: its digest names the run.
  const recording::Sink sink =
      *log ? *log : recording::Sink{[](std::span<const std::uint8_t>) { return true; }};
  auto result = bench::run_lockstep(loaded, {.log = sink, .follow = follow}, other_logs);
  if (result) result->wall_s = (transport::monotonic_now() - begun).seconds();
  return result;
}

}  // namespace

std::vector<std::string> live_command(const RunOptions& options) {
  std::vector<std::string> command{own_program(), "run", options.scenario, "--live", "--here"};
  const auto add = [&command](const std::string& flag, const std::string& value) {
    if (value.empty()) return;
    command.push_back(flag);
    command.push_back(value);
  };
  add("--interface", options.interface);
  add("--out", options.folder);
  add("--radio-port", std::to_string(options.radio_port));
  add("--uplink-port", std::to_string(options.uplink_port));
  if (options.bay != 0) add("--bay", std::to_string(options.bay));
  add("--keys", options.keys);
  add("--clock", options.clock);
  add("--report", options.report_folder);
  add("--progress", options.progress_file);
  add("--record", options.record_folder);
  add("--sensors", options.sensors_file);
  if (options.report_folder.empty()) {
    add("--log", options.log_file);
    add("--json", options.json_file);
  }
  if (options.duration) add("--duration", std::to_string(options.duration->seconds()));
  if (options.seed) add("--seed", std::to_string(*options.seed));
  if (options.candump) command.emplace_back("--candump");
  if (options.no_guardian) command.emplace_back("--no-guardian");
  if (options.cut) command.emplace_back("--cut");
  return command;
}

namespace {

Result<bench::RunResult, Problem> drive(const RunOptions& options, const bench::Loaded& loaded,
                                        const bench::Follow& follow) {
  return options.live ? run_live(options, loaded, follow) : lockstep(options, loaded, follow);
}

// A line that the disk does not take is lost; the run goes on.
Result<bench::RunResult, Problem> followed(const RunOptions& options, const bench::Loaded& loaded) {
  if (options.progress_file.empty()) return drive(options, loaded, {});
  auto file = transport::AppendWriter::open(options.progress_file,
                                            transport::AppendWriter::Start::kTruncate);
  if (!file) return Unexpected{file.error()};
  bench::Progress progress{loaded.scenario, options.live ? "live" : "lockstep",
                           [&](const std::string& line) { file->write(line + "\n"); }};
  auto result = drive(options, loaded, [&](const bench::RunView& run) { progress.observe(run); });
  if (result)
    progress.ended(*result);
  else
    progress.failed(result.error());
  return result;
}

// Each expectation that the run is too short for is told and left out.
Result<bool, Problem> cut(scenario::Scenario& scenario) {
  const Instant end = Instant{} + scenario.duration;
  if (scenario.match) scenario.match->is_cut = true;
  std::erase_if(scenario.expect, [&](const grading::Expectation& expectation) {
    if (is_shown_by(expectation, end)) return false;
    std::printf("not judged, the run is cut at %.1f s: %s: %s\n", end.seconds(),
                expectation.name.c_str(), expectation.condition.signal.c_str());
    return true;
  });
  if (!scenario.expect.empty()) return true;
  return Unexpected{Problem{"--duration", "ends before there is anything to judge"}};
}

Result<bench::Loaded, Problem> load(const RunOptions& options) {
  if (options.text) return bench::load_text(*options.text, options.scenario, "");
  return bench::load(options.scenario, "");
}

// The exit code; the files that were asked for are written.
Result<int, Problem> run_once(const RunOptions& options) {
  auto loaded = load(options);
  if (!loaded) return Unexpected{loaded.error()};
  const Duration planned = loaded->scenario.duration;
  if (options.duration) {
    loaded->scenario.duration = *options.duration;
    for (bench::LoadedStack& other : loaded->stacks) other.scenario.duration = *options.duration;
  }
  if (options.cut && loaded->scenario.duration < planned) {
    if (const auto left = cut(loaded->scenario); !left) return Unexpected{left.error()};
  }
  if (options.seed) loaded->scenario.seed = *options.seed;
  const auto result = followed(options, *loaded);
  if (!result) return Unexpected{result.error()};
  if (!options.quiet) std::printf("%s", bench::to_text(*result).c_str());
  std::fflush(stdout);
  if (!options.json_file.empty()) {
    const auto written = transport::write_file(options.json_file, bench::to_json(*result) + "\n");
    if (!written) return Unexpected{written.error()};
  }
  if (!result->not_judged().empty()) return kExitUnusable;
  if (result->passed()) return kExitPass;
  return result->failed_by_contact() ? kExitContact : kExitFailed;
}

// As many runs as fill the hours; the exit code of the first that failed.
Result<int, Problem> run_hours(RunOptions options) {
  const auto loaded = load(options);
  if (!loaded) return Unexpected{loaded.error()};
  const double each_s = options.duration.value_or(loaded->scenario.duration).seconds();
  const std::uint64_t first = options.seed.value_or(loaded->scenario.seed);
  const auto runs = static_cast<std::uint64_t>(std::ceil(options.hours * 3600.0 / each_s));
  for (std::uint64_t run = 0; run < runs; ++run) {
    options.seed = first + run;
    const auto code = run_once(options);
    if (!code) return code;
    std::printf(
        "seed %llu: %llu of %llu runs of %.0f s\n", static_cast<unsigned long long>(*options.seed),
        static_cast<unsigned long long>(run + 1), static_cast<unsigned long long>(runs), each_s);
    if (*code != kExitPass) return code;
  }
  return kExitPass;
}

int report_failure(const RunOptions& options, const Problem& problem) {
  if (!options.report_folder.empty()) write_report(report_files(options.report_folder), problem);
  return refuse(problem);
}

}  // namespace

int run_scenario(const RunOptions& options) {
  const auto code = options.hours > 0.0 ? run_hours(options) : run_once(options);
  if (!code) return report_failure(options, code.error());
  if (options.report_folder.empty()) return *code;
  return write_report(report_files(options.report_folder), std::nullopt);
}

Result<std::vector<std::string>, Problem> exec_arguments(const RunOptions& options,
                                                         std::span<const std::string> other_buses) {
  std::vector<std::string> words{"exec", "--auto", "--interface", options.interface};
  for (const std::string& bus : other_buses) words.insert(words.end(), {"--interface", bus});
  if (!other_buses.empty()) {  // each car with a stack locks its memory
    const int cars = 1 + static_cast<int>(other_buses.size());
    const int each_mib = can_bus::BusExecOptions{}.memory_mib;
    words.insert(words.end(), {"--memory", std::to_string(cars * each_mib)});
  }
  if (is_clock_file(options.clock)) words.insert(words.end(), {"--clock", options.clock});
  RunOptions inside = options;
  inside.clock = on_host(options.clock);
  if (options.radio_port != 0) {
    std::uint16_t uplink_port = options.uplink_port;
    if (uplink_port == 0) {  // the guest's end needs a port to be answered at
      const auto any = transport::UdpSocket::bind({});
      if (!any) return Unexpected{any.error()};
      uplink_port = any->local().port;
    }
    inside.radio_port = kLineRadioPort;
    inside.uplink_port = kLineUplinkPort;
    words.insert(words.end(),
                 {"--line-udp",
                  std::to_string(uplink_port) + ":" + std::to_string(options.radio_port) + ":" +
                      std::to_string(kLineRadioPort) + ":" + std::to_string(kLineUplinkPort)});
  }
  words.emplace_back("--");
  for (std::string& word : live_command(inside)) words.push_back(std::move(word));
  return words;
}

namespace {

int run_where_the_bus_is(const RunOptions& options) {
  // By bench time a late wake-up costs no simulated time, and what keeps a processor awake takes
  // half the speed from a guest.
  const bool by_wall_clock = clock_place(options.clock, options.attach).file.empty();
  const bench::KeepAwake awake{options.live && by_wall_clock && bench::is_virtual_machine()};
  if (!options.live || options.here) return run_scenario(options);

  // Bad input is told before a machine is booted for it.
  const auto loaded = bench::load(options.scenario, "");
  if (!loaded) return report_failure(options, loaded.error());
  const auto plans = plans_of(options, *loaded);
  if (!plans) return report_failure(options, plans.error());
  if (transport::is_unix_bus(options.interface)) {  // needs no guest, only a hub for each bus
    const std::string clock = clock_place(options.clock, options.attach).file;
    std::vector<std::optional<can_bus::OwnHub>> hubs;
    for (const bench::LivePlan& plan : *plans) {
      auto hub = can_bus::OwnHub::start(own_program(), plan.interface, clock);
      if (!hub) return refuse(hub.error());
      hubs.push_back(*std::move(hub));
    }
    return run_scenario(options);
  }
  std::vector<std::string> other_buses;
  for (const bench::LivePlan& plan : std::span{*plans}.subspan(1))
    other_buses.push_back(plan.interface);
  const auto exec = exec_arguments(options, other_buses);
  if (!exec) return refuse(exec.error());
  const int code = can_bus::bus_verb(*exec);
  if (!options.report_folder.empty() && !fs::exists(report_files(options.report_folder).html))
    return report_failure(options, {options.scenario, "the guest ended without a report"});
  return code;
}

}  // namespace

int run_as_told(RunOptions options) {
  if (!options.report_folder.empty()) {
    if (const auto problem = prepare_report(options.report_folder)) return refuse(*problem);
    options.log_file = report_files(options.report_folder).log;
    options.json_file = report_files(options.report_folder).result;
  }
  if (options.candump && transport::is_unix_bus(options.interface)) {
    std::fprintf(stderr, "%s: candump hears SocketCAN only: not recorded (--log has the frames)\n",
                 options.interface.c_str());
    options.candump = false;
  }
  return run_where_the_bus_is(options);
}

int run_verb(std::span<const std::string> args) {
  RunOptions options;
  double duration_s = 0.0;
  std::uint64_t seed = 0;
  CommandLine app{"pitwall-hil run: one scenario in the bench"};
  app.option("scenario", options.scenario, "scenario file").required();
  const VerbOption live =
      app.flag("--live", options.live, "real SocketCAN, real car process, real time");
  const VerbOption here =
      app.flag("--here", options.here, "live: the interface exists here already");
  app.flag("--attach", options.attach, "live: the car runs already; only with --here").needs(here);
  app.flag("--no-guardian", options.no_guardian, "live: the car alone");
  app.option("--clock", options.clock,
             "live: bench (its time stands while the machine holds a process up; the default), "
             "wall, or a FILE to keep bench time in, for a base station with the same --clock");
  app.option("--interface", options.interface,
             "live: CAN interface, vcan1 after vcan0 for another car with a stack; or unix:PATH, "
             "then unix:PATH.NAME");
  const VerbOption log =
      app.option("--log", options.log_file,
                 "write the event log, FILE.mcap; of another car with a stack FILE.NAME.mcap");
  const VerbOption json = app.option("--json", options.json_file, "write the result as JSON");
  app.option("--report", options.report_folder,
             "write event log, result, page and JUnit file into this folder")
      .excludes(log)
      .excludes(json);
  app.option("--out", options.folder,
             "live: folder for the car's summary and the candump; default " + options.folder);
  app.flag("--candump", options.candump, "live: record the bus with candump");
  app.option("--record", options.record_folder,
             "live: folder for the car's own recording, which `compare` drives again");
  app.option(
      "--sensors", options.sensors_file,
      "live: sensor file of the car; the bench publishes detections of the other cars on the "
      "topics of its rows that detect cars");
  app.option("--radio-port", options.radio_port, "live: pass the car's datagrams on to this port");
  app.option("--uplink-port", options.uplink_port, "live: answers of the base come here");
  app.option("--bay", options.bay, "live: of the benches that run on this machine at once")
      .range(0, bench::kBaysMax - 1);
  app.option("--keys", options.keys,
             "live: folder of car.keys and base.keys; default: new ones for this run");
  const VerbOption duration =
      app.option("--duration", duration_s, "seconds, instead of the file's").range(0.1, 36'000.0);
  const VerbOption progress =
      app.option("--progress", options.progress_file, "write a line of JSON for each half second");
  app.flag("--cut", options.cut, "expectations of a time that --duration cuts away are not judged")
      .needs(duration);
  app.option("--hours", options.hours, "lockstep: with one seed after the other, so long")
      .range(0.001, 1'000.0)
      .excludes(log)
      .excludes(json)
      .excludes(progress)
      .excludes(live);
  const VerbOption with_seed =
      app.option("--seed", seed, "instead of the file's").range(0, 1'000'000'000);
  if (const auto code = app.ended_by(args)) return *code;
  if (duration.given()) options.duration = from_seconds(duration_s);
  if (with_seed.given()) options.seed = seed;
  return run_as_told(std::move(options));
}

}  // namespace pitwall::cli
