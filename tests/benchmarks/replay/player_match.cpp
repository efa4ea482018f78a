// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/player_match.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "hil/cli/run_verb.hpp"
#include "hil/replay/writers/candump_writer.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::benchmarks {
namespace {

namespace fs = std::filesystem;
using replay::CanLog;
using replay::Comparison;

constexpr std::size_t kBytesPerFrame = 512;  // asked of the receive buffer; the kernel doubles
constexpr std::size_t kMaxBufferBytes = 64 << 20;
constexpr std::size_t kWarmUpFrames = 200;
constexpr std::size_t kRoomForExtra = 4'096;
constexpr Duration kSettle = milliseconds(100);  // after a player's end, until the last arrival
constexpr Duration kPatience = seconds(60);      // beyond the length of the log
constexpr Duration kDrainPeriod = milliseconds(250);  // where the buffer does not hold a run
constexpr int kFloorPriority = 50;
constexpr int kFloorSleeps = 1'000;
constexpr Duration kFloorPeriod = milliseconds(1);

std::vector<std::string> command_of(std::size_t player, const MatchPlan& plan, const CanLog& log,
                                    const std::string& log_file) {
  if (player == kOurs)
    return {(fs::path(cli::own_program()).parent_path().parent_path() / "hil/pitwall-hil").string(),
            "replay",
            log_file,
            "--interface",
            plan.interface,
            "--json",
            plan.folder + "/ours.json"};
  if (player == kCanplayer) {
    std::vector<std::string> command{"canplayer", "-I", log_file};
    for (const std::string& channel : log.channels)
      command.push_back(plan.interface + "=" + channel);
    return command;
  }
  std::vector<std::string> command{"/usr/bin/python3", "-m", "can.player",  "-i",
                                   "socketcan",        "-c", plan.interface};
  const bool fd = std::any_of(log.frames.begin(), log.frames.end(),
                              [](const auto& logged) { return logged.frame.fd; });
  if (fd) command.emplace_back("--fd");
  command.push_back(log_file);
  return command;
}

Duration length_of(const CanLog& log) {
  const auto [first, last] =
      std::minmax_element(log.frames.begin(), log.frames.end(),
                          [](const auto& a, const auto& b) { return a.at < b.at; });
  return {last->at.ns - first->at.ns};
}

// Runs a player to its end; its standard output is not ours.
std::optional<Problem> run_player(std::vector<std::string> command, Duration length,
                                  const std::function<void()>& meanwhile) {
  const std::string name = command[0];
  command.insert(command.begin(), {"sh", "-c", "exec \"$@\" > /dev/null", "sh"});
  auto process = transport::Process::spawn({.argv = command});
  if (!process) return process.error();
  const Instant give_up = transport::monotonic_now() + length + kPatience;
  while (transport::monotonic_now() < give_up) {
    const Duration pause = meanwhile ? kDrainPeriod : length + kPatience;
    const auto status = process->wait_until(transport::monotonic_now() + pause);
    if (meanwhile) meanwhile();
    if (!status) continue;
    if (status->success()) return std::nullopt;
    return Problem{name, "ended with code " + std::to_string(status->shell_code()) +
                             (status->shell_code() == 127 ? " (not installed?)" : "")};
  }
  process->kill(SIGKILL);
  return Problem{name, "did not end"};
}

Result<Comparison, Problem> record_run(std::vector<std::string> command, const MatchPlan& plan,
                                       const CanLog& log) {
  const std::size_t wanted = std::min(log.frames.size() * kBytesPerFrame, kMaxBufferBytes);
  auto recorder = transport::CanSocket::open(
      plan.interface, {.receive_errors = false, .receive_buffer_bytes = static_cast<int>(wanted)});
  if (!recorder) return Unexpected{recorder.error()};
  std::vector<can::ReceivedFrame> arrived(log.frames.size() + kRoomForExtra);
  std::size_t taken = 0;
  const auto drain = [&] { taken += recorder->receive(std::span(arrived).subspan(taken)); };
  const auto granted = static_cast<std::size_t>(recorder->receive_buffer_bytes());
  const bool holds_all = granted >= log.frames.size() * kBytesPerFrame;
  const auto problem =
      run_player(std::move(command), length_of(log), holds_all ? std::function<void()>{} : drain);
  if (problem) return Unexpected{*problem};
  transport::sleep_until(transport::monotonic_now() + kSettle);
  drain();
  recorder->poll_drops();
  if (recorder->counters().rx_dropped_queue > 0)
    return Unexpected{Problem{plan.interface, "the recorder lost frames"}};
  arrived.resize(taken);
  return replay::compare(log.frames, arrived);
}

std::optional<Problem> warm_up(const MatchPlan& plan, const CanLog& log) {
  CanLog start = log;
  start.frames.resize(std::min(start.frames.size(), kWarmUpFrames));
  const std::string file = plan.folder + "/warm_up.log";
  const auto written = transport::write_file(file, to_candump(start));
  if (!written) return written.error();
  for (std::size_t player = 0; player < kPlayers; ++player)
    if (auto problem = run_player(command_of(player, plan, log, file), length_of(start), {}))
      return problem;
  return std::nullopt;
}

std::vector<Duration> sleep_lateness() {
  std::vector<Duration> late;
  late.reserve(kFloorSleeps);
  static_cast<void>(transport::request_realtime(kFloorPriority));
  Instant due = transport::monotonic_now();
  for (int i = 0; i < kFloorSleeps; ++i) {
    due += kFloorPeriod;
    transport::sleep_until(due);
    late.push_back(transport::monotonic_now() - due);
  }
  transport::release_realtime();
  return late;
}

}  // namespace

Result<MatchFigures, Problem> play_match(const MatchPlan& plan, const CanLog& log) {
  MatchFigures out;
  if (const auto bus = transport::CanSocket::open(plan.interface); !bus)
    return Unexpected{bus.error()};
  if (const auto problem = warm_up(plan, log)) return Unexpected{*problem};
  const auto reading = measure_reading(log, plan.folder);
  if (!reading) return Unexpected{reading.error()};
  out.reading = *reading;
  std::vector<Duration> floor;
  for (int run = 0; run < plan.runs; ++run) {
    for (const Duration late : sleep_lateness()) floor.push_back(late);
    for (std::size_t i = 0; i < kPlayers; ++i) {
      const std::size_t player = (i + static_cast<std::size_t>(run)) % kPlayers;
      auto result = record_run(command_of(player, plan, log, plan.log_file), plan, log);
      if (!result) return Unexpected{result.error()};
      out.runs[player].push_back(*std::move(result));
    }
  }
  out.noise_floor = replay::quantiles_of(std::move(floor));
  out.own_report = transport::read_file(plan.folder + "/ours.json").value_or("");
  return out;
}

}  // namespace pitwall::benchmarks
