// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/player_match.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "hil/cli/live/programs.hpp"
#include "hil/replay/recordings/recording_reader.hpp"
#include "hil/replay/timeline.hpp"
#include "hil/replay/writers/candump_writer.hpp"
#include "protocol/recorder/can_record.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/realtime.hpp"
#include "tests/benchmarks/replay/receiver_ports.hpp"

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
constexpr Duration kTimeout = seconds(60);       // beyond the length of the log
constexpr Duration kDrainPeriod = milliseconds(100);  // of what does not hold a run
constexpr int kFloorPriority = 50;
constexpr int kFloorSleeps = 1'000;
constexpr Duration kFloorPeriod = milliseconds(1);

// What our player plays with sensors, and where it is.
struct SensorPlan {
  std::string file;
  std::vector<SensorDatagram> datagrams;
  Duration pass{};
};

std::string topic_of(std::size_t receiver) { return "/gnss/" + std::to_string(receiver); }

// Of no socket: a timeline has to tell the receivers apart, wherever they are.
UdpAddress any_address(std::size_t receiver) {
  return {.port = static_cast<std::uint16_t>(1 + receiver)};
}

std::string own_player() {
  return (fs::path(cli::own_program()).parent_path().parent_path() / "hil/pitwall-hil").string();
}

std::vector<std::string> own_command(const MatchPlan& plan, const std::string& log_file) {
  return {own_player(),
          "replay",
          log_file,
          "--interface",
          plan.interface,
          "--json",
          plan.folder + "/ours.json"};
}

std::vector<std::string> sensor_command(const MatchPlan& plan, const SensorPlan& sensors,
                                        const ReceiverPorts& ports) {
  std::vector<std::string> command{own_player(),
                                   "replay",
                                   sensors.file,
                                   "--map",
                                   std::string(recorder::kReceivedTopic) + "=" + plan.interface,
                                   "--loop",
                                   std::to_string(kSensorPasses),
                                   "--json",
                                   plan.folder + "/with_sensors.json"};
  for (std::size_t receiver = 0; receiver < kReceivers; ++receiver) {
    command.emplace_back("--receiver");
    command.push_back(topic_of(receiver) + "=" + ports.address(receiver));
  }
  return command;
}

// Of every player but the one with sensors.
std::vector<std::string> command_of(std::size_t player, const MatchPlan& plan, const CanLog& log,
                                    const std::string& log_file) {
  if (player == kOurs) return own_command(plan, log_file);
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
  const Instant give_up = transport::monotonic_now() + length + kTimeout;
  while (transport::monotonic_now() < give_up) {
    const Duration pause = meanwhile ? kDrainPeriod : length + kTimeout;
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

// A socket on the bus that is emptied after the run, or during it where it does not hold all of it.
class BusRecorder {
 public:
  static Result<BusRecorder, Problem> open(const std::string& interface, std::size_t frames,
                                           Duration clock_offset) {
    const std::size_t wanted = std::min(frames * kBytesPerFrame, kMaxBufferBytes);
    auto socket =
        transport::CanSocket::open(interface, {.receive_errors = false,
                                               .receive_buffer_bytes = static_cast<int>(wanted),
                                               .clock_offset = clock_offset});
    if (!socket) return Unexpected{socket.error()};
    return BusRecorder{*std::move(socket), frames};
  }

  bool holds_all() const {
    const auto granted = static_cast<std::size_t>(socket_.receive_buffer_bytes());
    return granted >= frames_ * kBytesPerFrame;
  }
  void drain() { taken_ += socket_.receive(std::span(arrived_).subspan(taken_)); }
  std::span<const can::ReceivedFrame> arrived() const { return std::span(arrived_).first(taken_); }
  bool lost_frames() {
    socket_.poll_drops();
    return socket_.counters().rx_dropped_queue > 0;
  }

 private:
  BusRecorder(transport::CanSocket socket, std::size_t frames)
      : socket_(std::move(socket)), frames_(frames), arrived_(frames + kRoomForExtra) {}

  transport::CanSocket socket_;
  std::size_t frames_, taken_ = 0;
  std::vector<can::ReceivedFrame> arrived_;
};

std::optional<Problem> finish(BusRecorder& bus, const MatchPlan& plan) {
  transport::sleep_until(transport::monotonic_now() + kSettle);
  bus.drain();
  if (bus.lost_frames()) return Problem{plan.interface, "the recorder lost frames"};
  return std::nullopt;
}

Result<Comparison, Problem> record_run(std::vector<std::string> command, const MatchPlan& plan,
                                       const CanLog& log) {
  auto bus =
      BusRecorder::open(plan.interface, log.frames.size(), transport::realtime_minus_monotonic());
  if (!bus) return Unexpected{bus.error()};
  const auto meanwhile = bus->holds_all() ? std::function<void()>{} : [&] { bus->drain(); };
  if (auto problem = run_player(std::move(command), length_of(log), meanwhile))
    return Unexpected{*problem};
  if (auto problem = finish(*bus, plan)) return Unexpected{*problem};
  return replay::compare(log.frames, bus->arrived());
}

Result<SensorArrival, Problem> record_sensor_run(const MatchPlan& plan, const CanLog& log,
                                                 const SensorPlan& sensors) {
  const Duration offset = transport::realtime_minus_monotonic();
  auto bus = BusRecorder::open(plan.interface, kSensorPasses * log.frames.size(), offset);
  if (!bus) return Unexpected{bus.error()};
  auto ports = ReceiverPorts::open(offset);
  if (!ports) return Unexpected{ports.error()};
  const bool bus_holds_all = bus->holds_all();
  const auto meanwhile = [&] {
    ports->drain();
    if (!bus_holds_all) bus->drain();
  };
  const Duration length = sensors.pass * std::int64_t{kSensorPasses};
  if (auto problem = run_player(sensor_command(plan, sensors, *ports), length, meanwhile))
    return Unexpected{*problem};
  if (auto problem = finish(*bus, plan)) return Unexpected{*problem};
  ports->drain();
  if (ports->lost() > 0) return Unexpected{Problem{"receivers", "a socket lost datagrams"}};
  return compare({.frames = log.frames,
                  .datagrams = sensors.datagrams,
                  .pass = sensors.pass,
                  .passes = kSensorPasses},
                 bus->arrived(), ports->received());
}

// The recording in a file, read as our player reads it: from it the length of a pass.
Result<SensorPlan, Problem> make_sensor_plan(const MatchPlan& plan, const CanLog& log) {
  SensorPlan out{.file = plan.folder + "/with_sensors.mcap",
                 .datagrams = sensor_traffic(log.frames.front().at, length_of(log)),
                 .pass = {}};
  auto bytes = to_recording(log, out.datagrams);
  if (!bytes) return Unexpected{bytes.error()};
  if (const auto written = transport::write_file(out.file, *bytes); !written)
    return Unexpected{written.error()};
  const auto recording = traffic::read_recording(*std::move(bytes), out.file);
  if (!recording) return Unexpected{recording.error()};
  replay::TimelineOptions options{.interface = plan.interface};
  for (std::size_t receiver = 0; receiver < kReceivers; ++receiver)
    options.receivers.emplace_back(topic_of(receiver), any_address(receiver));
  const auto timeline = replay::make_timeline(*recording, options);
  if (!timeline) return Unexpected{timeline.error()};
  out.pass = timeline->pass;
  return out;
}

std::optional<Problem> warm_up(const MatchPlan& plan, const CanLog& log) {
  CanLog start = log;
  start.frames.resize(std::min(start.frames.size(), kWarmUpFrames));
  const std::string file = plan.folder + "/warm_up.log";
  const auto written = transport::write_file(file, to_candump(start));
  if (!written) return written.error();
  for (const std::size_t player : {kOurs, kCanplayer, kPythonCan})
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

std::optional<Problem> run_one(std::size_t player, const MatchPlan& plan, const CanLog& log,
                               const SensorPlan& sensors, MatchFigures& out) {
  if (player == kWithSensors) {
    auto arrival = record_sensor_run(plan, log, sensors);
    if (!arrival) return arrival.error();
    out.runs[player].push_back(arrival->frames);
    out.sensors.push_back(*std::move(arrival));
    return std::nullopt;
  }
  auto result = record_run(command_of(player, plan, log, plan.log_file), plan, log);
  if (!result) return result.error();
  out.runs[player].push_back(*std::move(result));
  return std::nullopt;
}

}  // namespace

Result<MatchFigures, Problem> play_match(const MatchPlan& plan, const CanLog& log) {
  MatchFigures out;
  if (const auto bus = transport::CanSocket::open(plan.interface); !bus)
    return Unexpected{bus.error()};
  const auto sensors = make_sensor_plan(plan, log);
  if (!sensors) return Unexpected{sensors.error()};
  if (const auto problem = warm_up(plan, log)) return Unexpected{*problem};
  const auto reading = measure_reading(log, plan.folder);
  if (!reading) return Unexpected{reading.error()};
  out.reading = *reading;
  std::vector<Duration> floor;
  for (int run = 0; run < plan.runs; ++run) {
    for (const Duration late : sleep_lateness()) floor.push_back(late);
    for (std::size_t i = 0; i < kPlayers; ++i) {
      const std::size_t player = (i + static_cast<std::size_t>(run)) % kPlayers;
      if (auto problem = run_one(player, plan, log, *sensors, out)) return Unexpected{*problem};
    }
  }
  out.noise_floor = replay::quantiles_of(std::move(floor));
  out.own_report = transport::read_file(plan.folder + "/ours.json").value_or("");
  out.sensor_report = transport::read_file(plan.folder + "/with_sensors.json").value_or("");
  return out;
}

}  // namespace pitwall::benchmarks
