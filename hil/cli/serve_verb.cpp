// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/serve_verb.hpp"

#include <cstdint>
#include <cstdio>
#include <vector>

#include "hil/cli/bench_server/bench_socket.hpp"
#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/live/programs.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::cli {
namespace {

constexpr Duration kLongest = seconds(1);

// Of live runs: where their radio, their bus and their time are.
struct LiveOptions {
  std::string interface = "vcan0", keys, clock, sensors;
  std::uint16_t radio_port = 0, uplink_port = 0;
};

std::vector<std::string> run_command(const LiveOptions& words, const bench_server::Start& start,
                                     const std::string& report, const std::string& progress) {
  std::vector<std::string> command{
      own_program(), "run",  start.file,   "--seed", std::to_string(start.seed),
      "--report",    report, "--progress", progress};
  if (!start.live) return command;
  const std::vector<std::string> live{"--live",
                                      "--out",
                                      report + "/live",
                                      "--interface",
                                      words.interface,
                                      "--radio-port",
                                      std::to_string(words.radio_port),
                                      "--uplink-port",
                                      std::to_string(words.uplink_port)};
  command.insert(command.end(), live.begin(), live.end());
  if (!words.keys.empty()) command.insert(command.end(), {"--keys", words.keys});
  if (!words.clock.empty()) command.insert(command.end(), {"--clock", words.clock});
  if (!words.sensors.empty()) command.insert(command.end(), {"--sensors", words.sensors});
  return command;
}

}  // namespace

int serve_verb(std::span<const std::string> args) {
  bench_server::ServerPlan plan{.socket = {},
                                .scenarios = "hil/scenarios",
                                .runs = "out/bench",
                                .sweeps = "out/sweeps",
                                .command = {}};
  LiveOptions words;
  CommandLine app{"pitwall-hil serve: starts scenarios for who asks at a socket"};
  app.option("--socket", plan.socket, "where clients connect").required();
  app.option("--scenarios", plan.scenarios, "folder of scenario files").shows_default();
  app.option("--runs", plan.runs, "each run leaves its files in a folder of this one")
      .shows_default();
  app.option("--sweeps", plan.sweeps, "folder of sweeps, which are listed").shows_default();
  app.option("--interface", words.interface, "live runs: CAN interface").shows_default();
  app.option("--radio-port", words.radio_port, "live runs: the car's datagrams go on to this port");
  app.option("--uplink-port", words.uplink_port, "live runs: answers of the base come here");
  app.option("--keys", words.keys, "live runs: folder of car.keys and base.keys");
  app.option("--clock", words.clock,
             "live runs: FILE to keep bench time in, for a base station with the same --clock");
  app.option("--sensors", words.sensors, "live runs: sensor file of the car; a match needs one");
  if (const auto code = app.ended_by(args)) return *code;
  plan.command = [words](const bench_server::Start& start, const std::string& report,
                         const std::string& progress) {
    return run_command(words, start, report, progress);
  };
  auto stop = transport::StopSignal::install();
  if (!stop) return refuse(stop.error());
  auto server = bench_server::BenchSocket::open(std::move(plan));
  if (!server) return refuse(server.error());
  std::printf("%zu scenarios\n", server->server().scenarios().size());
  std::fflush(stdout);
  while (!stop->raised()) server->serve(transport::monotonic_now() + kLongest, stop->fd());
  return kExitPass;
}

}  // namespace pitwall::cli
