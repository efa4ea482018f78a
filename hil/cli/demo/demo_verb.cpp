// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/demo/demo_verb.hpp"

#include <netinet/in.h>
#include <sys/socket.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hil/bench/live/process_supervisor.hpp"
#include "hil/bench/live/run_keys.hpp"
#include "hil/bench/loading.hpp"
#include "hil/cli/command_line.hpp"
#include "hil/cli/demo/demo_cars.hpp"
#include "hil/cli/demo/demo_report.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/live/car_plans.hpp"
#include "hil/cli/live/programs.hpp"
#include "hil/cli/run_verb.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::cli {
namespace {

namespace fs = std::filesystem;

constexpr Duration kBaseStart = seconds(20), kBaseLook = milliseconds(20);
constexpr std::uint32_t kLoopback = 0x7F00'0001U;
constexpr const char* kWithGhost = "hil/scenarios/matches/competition.yaml";
constexpr const char* kWithTwoStacks = "hil/scenarios/matches/competition_two_stacks.yaml";

struct DemoOptions {
  bool headless = false;
  std::optional<Duration> duration;  // shorter than the scenario
  int web_port = 8080;               // of the console; 0: any that is free
  std::string json_file, folder = "out/demo", scenario;
  std::string sensors = "vehicle/config/sensors/av21.yaml";
};

// One time for all who are on this machine.
std::string clock_file() { return "/dev/shm/pitwall-demo-clock-" + std::to_string(::getpid()); }

std::vector<std::string> base_words(const DemoOptions& options, const bench::Loaded& loaded,
                                    std::span<const DemoCar> cars) {
  std::vector<std::string> words{beside("basestation/pitwall-base"),
                                 "--text",
                                 "--web",
                                 std::to_string(options.web_port),
                                 "--track",
                                 loaded.scenario.track_file,
                                 "--clock",
                                 clock_file()};
  std::vector<std::string> of_one{
      "--listen",    "127.0.0.1:" + std::to_string(cars.front().base_port),
      "--keys",      options.folder + "/keys/base.keys",
      "--json",      options.folder + "/base.json",
      "--record",    options.folder + "/recording",
      "--judgement", options.folder + "/judgement.yaml"};
  if (!cars.front().commands.empty())
    of_one.insert(of_one.end(), {"--command", cars.front().commands});
  const std::vector<std::string> of_several{"--cars", options.folder + "/cars.yaml"};
  const auto& more = cars.size() == 1 ? of_one : of_several;
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// What the program says goes into a file.
std::vector<std::string> with_output_in(const std::string& file, std::vector<std::string> words) {
  words.insert(words.begin(), {"sh", "-c", "out=$1; shift; exec \"$@\" > \"$out\"", "sh", file});
  return words;
}

Result<transport::Process, Problem> start_base(const DemoOptions& options,
                                               const bench::Loaded& loaded,
                                               std::span<const DemoCar> cars) {
  std::vector<std::string> words = base_words(options, loaded, cars);
  if (!options.headless) return transport::Process::spawn({.argv = words});
  words.emplace_back("--plain");
  return transport::Process::spawn(
      {.argv = with_output_in(options.folder + "/base_screen.txt", std::move(words))});
}

// Whether a program on this machine takes connections at this port.
bool is_served(int port) {
  using transport::posix_call;
  const transport::FileDescriptor socket{
      posix_call([] { return ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0); })};
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(kLoopback);
  const auto* const to = static_cast<const sockaddr*>(static_cast<const void*>(&address));
  return posix_call([&] { return ::connect(socket.get(), to, sizeof address); }).ok();
}

// Nothing else starts before the base serves its console, or without it.
Result<transport::Process, Problem> start_serving_base(const DemoOptions& options,
                                                       const bench::Loaded& loaded,
                                                       std::span<const DemoCar> cars) {
  const std::string place = "--web " + std::to_string(options.web_port);
  if (options.web_port != 0 && is_served(options.web_port)) {
    return Unexpected{Problem{place, "another program serves this port; end it or take another"}};
  }
  // Not before: it could be that of a demo that runs.
  for (const DemoCar& car : cars)
    if (auto aside = set_recordings_aside(car); !aside) return Unexpected{aside.error()};
  auto base = start_base(options, loaded, cars);
  if (!base) return base;
  const Instant end = transport::monotonic_now() + kBaseStart;
  while (transport::monotonic_now() < end) {
    if (base->wait_until(transport::monotonic_now() + kBaseLook)) {
      return Unexpected{Problem{"pitwall-base", "did not start; its own message is above"}};
    }
    if (options.web_port == 0 || is_served(options.web_port)) return base;
  }
  return Unexpected{Problem{place, "the base station serves no console"}};
}

// Several cars have Unix-socket buses: a guest has one processor for all of them.
RunOptions run_options(const DemoOptions& options, const bench::Loaded& loaded) {
  RunOptions run;
  run.scenario = options.scenario;
  run.live = true;
  run.folder = run.report_folder = options.folder;
  run.duration = options.duration;
  run.cut = options.duration.has_value();
  run.interface = loaded.stacks.empty() ? "vcan0" : "unix:" + options.folder + "/bus";
  run.keys = options.folder + "/keys";
  run.record_folder = options.folder + "/car_recording";
  if (!loaded.scenario.cars.empty()) run.sensors_file = options.sensors;
  run.clock = clock_file();
  run.radio_port = kDemoBasePort;
  run.uplink_port = kDemoUplinkPort;
  run.candump = loaded.stacks.empty();
  return run;
}

// Folders, keys, what the operator says, the base's file of cars.
Result<bool, Problem> prepare(const DemoOptions& options, const bench::Loaded& loaded,
                              std::span<const DemoCar> cars) {
  for (const DemoCar& car : cars) {
    std::error_code error;
    fs::create_directories(car.folder, error);
    if (error) return Unexpected{Problem{car.folder, error.message()}};
    auto made = bench::make_run_keys(car.keys);
    if (!made) return made;
  }
  if (const std::string& commands = cars.front().commands; !commands.empty()) {
    auto written = transport::write_file(commands, commands_text(loaded.scenario.operator_texts));
    if (!written) return written;
  }
  if (cars.size() == 1) return true;
  return transport::write_file(options.folder + "/cars.yaml", cars_text(cars));
}

void greet(const DemoOptions& options, const bench::Loaded& loaded) {
  std::printf(
      "SIMULATION: %s, at most %.0f s of simulated time. The car, the bench and the base station\n"
      "are separate processes; the tyres start at working temperature.\n",
      options.scenario.c_str(), options.duration.value_or(loaded.scenario.duration).seconds());
  if (!loaded.stacks.empty())
    std::printf(
        "%zu cars with a full stack on one track and at one base. Their buses are Unix sockets,\n"
        "not SocketCAN.\n",
        1 + loaded.stacks.size());
  if (options.web_port != 0)
    std::printf("The operator's console: http://localhost:%d\n", options.web_port);
  std::fflush(stdout);
}

int report(const DemoOptions& options, std::span<const DemoCar> cars, int code) {
  const auto read = read_report(cars);
  if (!read) return refuse(read.error());
  std::printf("%s\n%s", to_text(*read).c_str(), next_steps(*read, options.scenario).c_str());
  if (!options.json_file.empty()) {
    const auto written = transport::write_file(options.json_file, to_json(*read) + "\n");
    if (!written) return refuse(written.error());
  }
  if (code != kExitPass) return code;
  const bool is_recorded = cars.size() > 1 || read->dumped > 0;
  return read->are_heard() && is_recorded ? kExitPass : kExitFailed;
}

int demo(const DemoOptions& options) {
  const auto loaded = bench::load(options.scenario, "");
  if (!loaded) return refuse(loaded.error());
  const RunOptions run = run_options(options, *loaded);
  if (const auto plans = plans_of(run, *loaded); !plans) return refuse(plans.error());
  const std::vector<DemoCar> cars = demo_cars(*loaded, options.folder);
  if (const auto ready = prepare(options, *loaded, cars); !ready) return refuse(ready.error());
  auto base = start_serving_base(options, *loaded, cars);
  if (!base) return refuse(base.error());
  greet(options, *loaded);
  const int code = run_as_told(run);
  base->kill(SIGTERM);
  if (!base->wait_until(transport::monotonic_now() + bench::ProcessSupervisor::kStopLimit))
    return refuse({"pitwall-base", "did not stop"});
  std::error_code none;
  fs::remove(clock_file(), none);
  if (code == kExitUnusable) return code;
  return report(options, cars, code);
}

}  // namespace

int demo_verb(std::span<const std::string> args) {
  DemoOptions options;
  double duration_s = 0.0;
  int cars = 1;
  CommandLine app{"pitwall-hil demo: the passing competition, live, with its base station"};
  app.flag("--headless", options.headless, "no live screen in this terminal");
  const VerbOption duration =
      app.option("--duration", duration_s, "seconds, instead of the scenario's")
          .range(1.0, 36'000.0);
  app.option("--json", options.json_file, "write the figures here");
  app.option("--web", options.web_port, "TCP port of the console on this machine; 0: any")
      .range(0, 65'535)
      .shows_default();
  app.option("--out", options.folder, "folder for logs");
  const VerbOption with_cars = app.option("--cars", cars, "with a full stack: 1 and a ghost, or 2")
                                   .range(1, 2)
                                   .shows_default();
  const VerbOption scenario =
      app.option("--scenario", options.scenario, "another scenario file").excludes(with_cars);
  app.option("--sensors", options.sensors, "sensor file of the cars, where there are several")
      .shows_default();
  if (const auto code = app.ended_by(args)) return *code;
  if (duration.given()) options.duration = from_seconds(duration_s);
  if (!scenario.given()) options.scenario = cars == 1 ? kWithGhost : kWithTwoStacks;
  return demo(options);
}

}  // namespace pitwall::cli
