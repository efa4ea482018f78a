// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/demo/demo_verb.hpp"

#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hil/bench/live/run_keys.hpp"
#include "hil/bench/loading.hpp"
#include "hil/can_bus/bus_verb.hpp"
#include "hil/can_bus/own_hub.hpp"
#include "hil/cli/command_line.hpp"
#include "hil/cli/demo/demo_cars.hpp"
#include "hil/cli/demo/demo_report.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/live/clock_place.hpp"
#include "hil/cli/live/programs.hpp"
#include "hil/cli/run_verb.hpp"
#include "protocol/transport/bench_clock/kept_clock.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/realtime.hpp"
#include "protocol/transport/virtual_machine.hpp"

namespace pitwall::cli {
namespace {

namespace fs = std::filesystem;

constexpr Duration kBaseStop = seconds(5), kBaseStart = seconds(20), kBaseLook = milliseconds(20);
// For the guest, and for what it writes at its end; and wall time per second of bench time, which
// stands often on a slow machine.
constexpr int kBootSeconds = 120, kSlowest = 8;
constexpr std::uint32_t kLoopback = 0x7F00'0001U;

struct DemoOptions {
  bool headless = false;
  double duration_s = 180.0;
  int web_port = 8080;  // of the console; 0: any that is free
  int cars = 1;
  std::string json_file, folder = "out/demo";
  std::string scenario = "hil/scenarios/lvms_flying_lap.yaml";
};

// One time for all who are on this machine. Each guest keeps its own, and a base station can follow
// one alone: where there are several, it goes by the wall clock.
bool is_time_shared(std::span<const DemoCar> cars) {
  return cars.size() == 1 || cars.front().bus == DemoBus::kSocket;
}
std::string clock_file() { return "/dev/shm/pitwall-demo-clock-" + std::to_string(::getpid()); }

std::vector<std::string> base_words(const DemoOptions& options, std::span<const DemoCar> cars) {
  const std::string program =
      (fs::path(own_program()).parent_path().parent_path() / "basestation/pitwall-base").string();
  std::vector<std::string> words{program,   "--text", "--web", std::to_string(options.web_port),
                                 "--track", "lvms"};
  const std::vector<std::string> of_one{
      "--listen",    "127.0.0.1:" + std::to_string(cars.front().base_port),
      "--keys",      options.folder + "/keys/base.keys",
      "--json",      options.folder + "/base.json",
      "--record",    options.folder + "/recording",
      "--judgement", options.folder + "/judgement.yaml"};
  const std::vector<std::string> of_several{"--cars", options.folder + "/cars.yaml"};
  const auto& more = cars.size() == 1 ? of_one : of_several;
  words.insert(words.end(), more.begin(), more.end());
  if (is_time_shared(cars)) words.insert(words.end(), {"--clock", clock_file()});
  return words;
}

// What the program says goes into a file.
std::vector<std::string> with_output_in(const std::string& file, std::vector<std::string> words) {
  words.insert(words.begin(), {"sh", "-c", "out=$1; shift; exec \"$@\" > \"$out\"", "sh", file});
  return words;
}

Result<transport::Process, Problem> start_base(const DemoOptions& options,
                                               std::span<const DemoCar> cars) {
  std::vector<std::string> words = base_words(options, cars);
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
                                                       std::span<const DemoCar> cars) {
  const std::string place = "--web " + std::to_string(options.web_port);
  if (options.web_port != 0 && is_served(options.web_port)) {
    return Unexpected{Problem{place, "another program serves this port; end it or take another"}};
  }
  // Not before: it could be that of a demo that runs.
  for (const DemoCar& car : cars)
    if (auto aside = set_recordings_aside(car); !aside) return Unexpected{aside.error()};
  auto base = start_base(options, cars);
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

// What runs a car's bench where its bus is.
std::vector<std::string> bench_options(const DemoOptions& options, const DemoCar& car) {
  RunOptions run;
  run.scenario = options.scenario;
  run.folder = car.folder;
  run.log_file = car.folder + "/events.mcap";
  run.json_file = car.folder + "/run.json";
  run.duration = from_seconds(options.duration_s);
  run.cut = true;
  run.interface = car.interface();
  run.bay = car.bay;
  run.keys = car.folder + "/keys";
  run.record_folder = car.own_recording();
  if (options.cars == 1 || car.bus == DemoBus::kSocket) run.clock = clock_file();
  if (car.bus == DemoBus::kSocket) {  // on this machine: no line into a guest
    run.radio_port = car.base_port;
    run.uplink_port = car.uplink_port;
    return live_command(run);
  }
  run.radio_port = car.radio_port;
  run.uplink_port = car.guest_uplink_port;
  run.candump = true;
  const std::string clock = std::exchange(run.clock, on_host(run.clock));
  std::vector<std::string> exec{
      own_program(),
      "bus",
      "exec",
      "--auto",
      "--interface",
      run.interface,
      "--line-udp",
      car.line_ports(),
      "--timeout",
      std::to_string(kSlowest * static_cast<int>(options.duration_s) + kBootSeconds)};
  if (!clock.empty()) exec.insert(exec.end(), {"--clock", clock});
  exec.emplace_back("--");
  for (std::string& word : live_command(run)) exec.push_back(std::move(word));
  return exec;
}

// The benches of several cars at once, each a process that speaks into a file of its own; the exit
// code of each.
Result<std::vector<int>, Problem> run_several(const DemoOptions& options,
                                              std::span<const DemoCar> cars) {
  std::optional<transport::KeptClock> clock;
  std::string of_hubs;
  if (is_time_shared(cars)) {
    of_hubs = clock_file();
    auto kept = transport::KeptClock::keep(clock_file());
    if (!kept) return Unexpected{kept.error()};
    clock.emplace(*std::move(kept));
  }
  std::vector<std::optional<can_bus::OwnHub>> hubs;  // outlive the benches
  std::vector<transport::Process> benches;
  for (const DemoCar& car : cars) {
    // A car's processor is that of its whole world.
    const transport::OnOneProcessor pinned{static_cast<int>(hubs.size())};
    auto hub = can_bus::OwnHub::start(own_program(), car.interface(), of_hubs);
    if (!hub) return Unexpected{hub.error()};
    hubs.push_back(*std::move(hub));
    auto bench = transport::Process::spawn(
        {.argv = with_output_in(car.folder + "/run.txt", bench_options(options, car))});
    if (!bench) return Unexpected{bench.error()};
    benches.push_back(*std::move(bench));
  }
  std::vector<int> codes;
  for (transport::Process& bench : benches) codes.push_back(bench.wait().shell_code());
  return codes;
}

Result<std::vector<int>, Problem> run_live(const DemoOptions& options,
                                           std::span<const DemoCar> cars) {
  if (cars.size() > 1) return run_several(options, cars);
  const std::vector<std::string> words = bench_options(options, cars.front());
  return std::vector{
      can_bus::bus_verb(std::span(words).subspan(2))};  // after the program and `bus`
}

// One that could not run, or was not judged, outweighs one that failed.
int worst(std::span<const int> codes) {
  int worst = kExitPass;
  for (const int code : codes) {
    if (code == kExitContact) worst = kExitContact;
    if (code == kExitFailed && worst == kExitPass) worst = kExitFailed;
    if (code != kExitPass && code != kExitFailed && code != kExitContact) return kExitUnusable;
  }
  return worst;
}

int report(const DemoOptions& options, std::span<const DemoCar> cars, std::span<const int> codes) {
  const bool several = cars.size() > 1;
  std::vector<CarReport> reports;
  std::string json;
  for (std::size_t i = 0; i < cars.size(); ++i) {
    if (several) {
      const auto output = transport::read_file(cars[i].folder + "/run.txt");
      std::printf("\ncar %d %s\n%s", cars[i].number, cars[i].name.c_str(),
                  output ? output->c_str() : "");
    }
    auto read = read_report(cars[i], codes[i]);
    if (!read) return refuse(read.error());
    std::printf("%s", to_text(*read).c_str());
    json += (i == 0 ? "" : ",") + to_json(*read);
    reports.push_back(*std::move(read));
  }
  if (several) std::printf("\n%s", apart_text(reports).c_str());
  if (!options.json_file.empty()) {
    const auto written = transport::write_file(
        options.json_file, (several ? "{\"cars\":[" + json + "]}" : json) + "\n");
    if (!written) return refuse(written.error());
  }
  const int code = worst(codes);
  if (code != kExitPass) return code;
  const bool held = std::ranges::all_of(reports, [](const CarReport& r) { return r.held(); });
  return held && (!several || are_apart(reports)) ? kExitPass : kExitFailed;
}

// Folders, keys, the base's file of cars.
Result<bool, Problem> prepare(const DemoOptions& options, std::span<const DemoCar> cars) {
  for (const DemoCar& car : cars) {
    std::error_code error;
    fs::create_directories(car.folder, error);
    if (error) return Unexpected{Problem{car.folder, error.message()}};
    auto made = bench::make_run_keys(car.folder + "/keys");
    if (!made) return made;
  }
  if (cars.size() == 1) return true;
  return transport::write_file(options.folder + "/cars.yaml", cars_text(cars));
}

int demo(const DemoOptions& options) {
  if (const auto loaded = bench::load(options.scenario, ""); !loaded) return refuse(loaded.error());
  const DemoBus bus = bus_for(options.cars, std::thread::hardware_concurrency());
  const std::vector<DemoCar> cars = demo_cars(options.cars, options.folder, bus);
  if (const auto ready = prepare(options, cars); !ready) return refuse(ready.error());
  const transport::KeepAwake awake;
  auto base = start_serving_base(options, cars);
  if (!base) return refuse(base.error());
  std::printf(
      "SIMULATION: %s for %.0f s in real time. The car, the bench and the base station are\n"
      "separate processes; the tyres start at working temperature.\n",
      options.scenario.c_str(), options.duration_s);
  if (cars.size() > 1) std::printf("%zu cars, each with a bench of its own.\n", cars.size());
  if (bus == DemoBus::kSocket) {
    std::printf(
        "Their buses are Unix sockets, not SocketCAN, and each has one core with its bench: this\n"
        "machine has %u.\n",
        std::thread::hardware_concurrency());
  }
  if (options.web_port != 0) {
    std::printf("The operator's console: http://localhost:%d\n", options.web_port);
  }
  std::fflush(stdout);
  const auto codes = run_live(options, cars);
  base->kill(SIGTERM);
  if (!base->wait_until(transport::monotonic_now() + kBaseStop))
    return refuse({"pitwall-base", "did not stop"});
  std::error_code none;  // where the base had the wall clock there is no file
  fs::remove(clock_file(), none);
  if (!codes) return refuse(codes.error());
  if (cars.size() == 1 && worst(*codes) == kExitUnusable) return kExitUnusable;
  return report(options, cars, *codes);
}

}  // namespace

int demo_verb(std::span<const std::string> args) {
  DemoOptions options;
  CommandLine app{"pitwall-hil demo: car, bench and base station on real SocketCAN"};
  app.flag("--headless", options.headless, "no live screen in this terminal");
  app.option("--duration", options.duration_s, "seconds").range(1.0, 36'000.0);
  app.option("--json", options.json_file, "write the figures here");
  app.option("--web", options.web_port, "TCP port of the console on this machine; 0: any")
      .range(0, 65'535)
      .shows_default();
  app.option("--out", options.folder, "folder for logs");
  app.option("--scenario", options.scenario, "scenario file");
  app.option("--cars", options.cars, "how many, each with a bench of its own")
      .range(1, kDemoCarsMax)
      .shows_default();
  if (const auto code = app.ended_by(args)) return *code;
  return demo(options);
}

}  // namespace pitwall::cli
