// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/demo_verb.hpp"

#include <netinet/in.h>
#include <sys/socket.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/bench/run_keys.hpp"
#include "hil/guest/bus_verb.hpp"
#include "hil/verbs/command_line.hpp"
#include "hil/verbs/exit_code.hpp"
#include "hil/verbs/run_verb.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::verbs {
namespace {

namespace fs = std::filesystem;

constexpr std::uint16_t kBasePort = 23'431;  // the base station listens here
constexpr std::uint16_t kUplinkPort = 23'531, kGuestUplinkPort = 23'532;
constexpr std::uint16_t kGuestRadioPort = 23'429;  // the bench sends the car's telemetry here
constexpr Duration kBaseStop = seconds(5), kBaseStart = seconds(20), kBaseLook = milliseconds(20);
constexpr std::uint32_t kLoopback = 0x7F00'0001U;

struct DemoOptions {
  bool headless = false;
  double duration_s = 180.0;
  int web_port = 8080;  // of the console; 0: any that is free
  std::string json_file, folder = "out/demo";
  std::string scenario = "hil/scenarios/lvms_flying_lap.yaml";
};

std::string line_ports() {
  return std::to_string(kUplinkPort) + ":" + std::to_string(kBasePort) + ":" +
         std::to_string(kGuestRadioPort) + ":" + std::to_string(kGuestUplinkPort);
}

Result<transport::Process, Problem> start_base(const DemoOptions& options) {
  const std::string program =
      (fs::path(own_program()).parent_path().parent_path() / "basestation/pitwall-base").string();
  std::vector<std::string> words{program,    "--text",
                                 "--listen", "127.0.0.1:" + std::to_string(kBasePort),
                                 "--keys",   options.folder + "/keys/base.keys",
                                 "--json",   options.folder + "/base.json",
                                 "--web",    std::to_string(options.web_port),
                                 "--track",  "lvms",
                                 "--record", options.folder + "/recording"};
  if (!options.headless) return transport::Process::spawn({.argv = words});
  words.emplace_back("--plain");
  words.insert(words.begin(), {"sh", "-c", "out=$1; shift; exec \"$@\" > \"$out\"", "sh",
                               options.folder + "/base_screen.txt"});
  return transport::Process::spawn({.argv = words});
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
Result<transport::Process, Problem> start_serving_base(const DemoOptions& options) {
  const std::string place = "--web " + std::to_string(options.web_port);
  if (options.web_port != 0 && is_served(options.web_port)) {
    return Unexpected{Problem{place, "another program serves this port; end it or take another"}};
  }
  auto base = start_base(options);
  if (!base) return base;
  const Instant end = transport::monotonic_now() + kBaseStart;
  while (transport::monotonic_now() < end) {
    if (base->wait_until(transport::monotonic_now() + kBaseLook)) {
      return Unexpected{Problem{"pitwall-base", "did not start; it has said above why"}};
    }
    if (options.web_port == 0 || is_served(options.web_port)) return base;
  }
  return Unexpected{Problem{place, "the base station serves no console"}};
}

int run_live(const DemoOptions& options) {
  RunOptions run;
  run.scenario = options.scenario;
  run.folder = options.folder;
  run.log_file = options.folder + "/events.mcap";
  run.json_file = options.folder + "/run.json";
  run.duration = from_seconds(options.duration_s);
  run.radio_port = kGuestRadioPort;
  run.uplink_port = kGuestUplinkPort;
  run.keys = options.folder + "/keys";
  run.candump = true;
  std::vector<std::string> exec{
      "exec",        "--auto",
      "--interface", run.interface,
      "--line-udp",  line_ports(),
      "--timeout",   std::to_string(static_cast<int>(options.duration_s) + 120),
      "--"};
  for (std::string& word : live_command(run)) exec.push_back(std::move(word));
  return guest::bus_verb(exec);
}

struct BaseFigures {
  std::int64_t packets = 0, lost = 0, refused = 0;
  double rate_hz = kUnset, age_p50_ms = kUnset, age_p99_ms = kUnset;
};

Result<BaseFigures, Problem> read_base(const std::string& path) {
  const auto document = yaml::load_file(path);
  if (!document) return Unexpected{document.error()};
  try {
    yaml::StrictMap map = document->root();
    BaseFigures base;
    base.packets = map.integer("packets", 0, 1'000'000'000);
    base.lost = map.integer("lost", 0, 1'000'000'000);
    base.refused = map.integer("refused", 0, 1'000'000'000);
    base.rate_hz = map.number("rate_hz", 0.0, 1e6);
    if (base.packets == 0) return base;  // then no age is known
    yaml::StrictMap age = map.map("age_ms");
    base.age_p50_ms = age.number("p50", 0.0, 1e9);
    base.age_p99_ms = age.number("p99", 0.0, 1e9);
    return base;  // its fields have more than this; that is the base station's own business
  } catch (const yaml::InputError& error) {
    return Unexpected{error.problem};
  }
}

std::size_t lines_of(const std::string& path) {
  const auto text = transport::read_file(path);
  return text ? static_cast<std::size_t>(std::count(text->begin(), text->end(), '\n')) : 0;
}

int report(const DemoOptions& options, int run_code) {
  const auto run = transport::read_file(options.folder + "/run.json");
  if (!run) return refuse(run.error());
  const auto base_text = transport::read_file(options.folder + "/base.json");
  if (!base_text) return refuse(base_text.error());
  const auto base = read_base(options.folder + "/base.json");
  if (!base) return refuse(base.error());
  const std::size_t dumped = lines_of(options.folder + "/candump.log");
  std::printf(
      "base station: %lld packets, %.1f Hz, %lld lost, %lld refused; age of the newest value "
      "p50 %.1f ms, p99 %.1f ms\n",
      static_cast<long long>(base->packets), base->rate_hz, static_cast<long long>(base->lost),
      static_cast<long long>(base->refused), base->age_p50_ms, base->age_p99_ms);
  std::printf("candump recorded %zu frames: %s/candump.log\nevent log: %s/events.mcap\n", dumped,
              options.folder.c_str(), options.folder.c_str());
  if (!options.json_file.empty()) {
    const auto written = transport::write_file(
        options.json_file, "{\"run\":" + *run + ",\"base\":" + *base_text +
                               ",\"candump_frames\":" + std::to_string(dumped) + "}\n");
    if (!written) return refuse(written.error());
  }
  return run_code != kExitPass || base->packets == 0 || dumped == 0 ? kExitFailed : kExitPass;
}

int demo(const DemoOptions& options) {
  if (const auto loaded = bench::load(options.scenario, ""); !loaded) return refuse(loaded.error());
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (error) return refuse({options.folder, error.message()});
  if (const auto made = bench::make_run_keys(options.folder + "/keys"); !made)
    return refuse(made.error());
  auto base = start_serving_base(options);
  if (!base) return refuse(base.error());
  std::printf(
      "SIMULATION: %s for %.0f s in real time. The car, the bench and the base station are\n"
      "separate processes; the tyres start at working temperature.\n",
      options.scenario.c_str(), options.duration_s);
  if (options.web_port != 0) {
    std::printf("The operator's console: http://localhost:%d\n", options.web_port);
  }
  std::fflush(stdout);
  const int code = run_live(options);
  base->kill(SIGTERM);
  if (!base->wait_until(transport::monotonic_now() + kBaseStop))
    return refuse({"pitwall-base", "did not stop"});
  if (code != kExitPass && code != kExitFailed) return kExitUnusable;
  return report(options, code);
}

}  // namespace

int demo_verb(std::span<const std::string> args) {
  DemoOptions options;
  CLI::App app{"pitwall-hil demo: car, bench and base station on real SocketCAN"};
  app.add_flag("--headless", options.headless, "no live screen in this terminal");
  app.add_option("--duration", options.duration_s, "seconds")->check(CLI::Range(1.0, 36'000.0));
  app.add_option("--json", options.json_file, "write the figures here");
  app.add_option("--web", options.web_port, "TCP port of the console on this machine; 0: any")
      ->check(CLI::Range(0, 65'535))
      ->capture_default_str();
  app.add_option("--out", options.folder, "folder for logs");
  app.add_option("--scenario", options.scenario, "scenario file");
  if (const auto code = ended_by(app, args)) return *code;
  return demo(options);
}

}  // namespace pitwall::verbs
