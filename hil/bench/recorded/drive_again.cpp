// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/drive_again.hpp"

#include <array>
#include <bit>

#include "protocol/bits/sha256.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "vehicle/io/black_box.hpp"
#include "vehicle/io/tick_inputs.hpp"
#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/car_setup.hpp"
#include "vehicle/parameters/track_file.hpp"
#include "vehicle/pipeline/telemetry_mapper.hpp"

namespace pitwall::bench {
namespace {

// Every figure of it is another one than in an IoCounters without measurements.
pipeline::IoCounters other_measurements() {
  pipeline::IoCounters io;
  io.frames_sent = io.tx_drops = io.steps = io.missed_deadlines = 1;
  io.step_time_max_us = io.step_time_p50_us = 1.0;
  io.processor_share = io.memory_mib = io.temperature_c = 1.0;
  io.heartbeats = io.heartbeats_refused = io.base_runs = io.slots_skipped = 1;
  io.threats = io.round_trip_ms = 1.0;
  io.paths.fill({.loss = 1.0, .delay_p99_ms = 1.0, .budget_use = 1.0});
  world::ReceiverTraffic traffic;
  traffic.bytes = traffic.logs = traffic.bad_checksum = traffic.bad_frame = traffic.resyncs = 1;
  traffic.refused = traffic.lost = 1;
  io.receivers.fill(traffic);
  io.lidar_frames = io.radar = {.rate_hz = 1.0, .gap_ms = 1.0, .latency_ms = 1.0, .drops = 1.0};
  io.lidars.fill(io.radar), io.cameras.fill(io.radar);
  io.uplink = {.known = true,
               .stop_latch = 1.0,
               .stop_challenge = 1.0,
               .stop_reason = 1.0,
               .authority = 1.0,
               .joystick = true,
               .schema_agrees = true};
  return io;
}

// The black box keeps what goes down to the base.
bool is_recorded(telemetry::Group group) {
  static constexpr telemetry::GroupSet kDown = telemetry::groups_of(telemetry::Direction::kDown);
  return kDown.has(group);
}

using telemetry::Group;
constexpr std::array kOpponents{Group::kOpponent1, Group::kOpponent2, Group::kOpponent3,
                                Group::kOpponent4};

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

std::string path_of(const RecordedRun& run, const std::string& key, const std::string& instead) {
  return instead.empty() ? run.metadata(key + "_file") : instead;
}

// The file that the run names under `key`_file, or the one that is given instead.
Result<std::string, Problem> known_path(const RecordedRun& run, const std::string& key,
                                        const std::string& instead) {
  const std::string path = path_of(run, key, instead);
  if (path.empty())
    return refuse("--" + key, "expected FILE, because the recording does not name it");
  return path;
}

void compare(const RecordedRun& run, const std::string& key, const std::string& path,
             const std::string& text, std::vector<std::string>& remarks) {
  bits::Sha256 hash;
  hash.update(as_bytes(text));
  const std::string recorded = run.metadata(key + "_sha256");
  if (!recorded.empty() && bits::to_hex(hash.digest()) != recorded)
    remarks.push_back(path + ": not the file that the run was driven with");
}

struct RunFile {
  std::string path, text;
};
Result<RunFile, Problem> file_of(const RecordedRun& run, const std::string& key,
                                 const std::string& instead, std::vector<std::string>& remarks) {
  const auto path = known_path(run, key, instead);
  if (!path) return Unexpected{path.error()};
  auto text = transport::read_file(*path);
  if (!text) return Unexpected{text.error()};
  compare(run, key, *path, *text, remarks);
  return RunFile{*path, *std::move(text)};
}

Result<parameters::CarFile, Problem> car_of(const RecordedRun& run, const std::string& instead,
                                            std::vector<std::string>& remarks) {
  const auto path = known_path(run, "car", instead);
  if (!path) return Unexpected{path.error()};
  auto car = parameters::load_car(
      *path, [](const std::string& file) { return transport::read_file(file); });
  if (car) compare(run, "car", *path, car->text, remarks);
  return car;
}

}  // namespace

DriveAgain::DriveAgain(const pipeline::Setup& setup)
    : setup_(setup),
      car_(std::make_unique<pipeline::Car>()),
      log_(std::make_unique<pipeline::TickLog>()),
      receivers_(setup.params.receivers) {}

Result<AgainTick, Problem> DriveAgain::tick(const RecordedTick& recorded) {
  receivers_.clear();
  for (const ReceiverBytes& some : recorded.receivers)
    receivers_.receive(static_cast<std::uint8_t>(some.unit), some.bytes, some.at);
  io::TickCommands commands;
  const auto in = io::inputs_of(recorded.given, recorded.now, recorded.received,
                                receivers_.samples(), commands);
  if (!in) return Unexpected{in.error()};
  const pipeline::Outputs out = pipeline::step(setup_, *car_, *in);
  log_->note(*in, out, setup_.track.length_m());
  AgainTick again;
  again.sent.assign(out.passed.frames.begin(), out.passed.frames.end());
  if (recorded.state) again.state = state_at(out, recorded.state->at);
  return again;
}

RecordedState DriveAgain::state_at(const pipeline::Outputs& out, Instant at) {
  const auto mapped = [&](const pipeline::IoCounters& io) {
    return pipeline::map_telemetry(
        {.setup = setup_, .car = *car_, .out = out, .log = *log_, .io = io, .now = at});
  };
  const telemetry::Snapshot snapshot = mapped({});
  const telemetry::Values other = mapped(other_measurements()).values;
  for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i)
    if (!same_bits(snapshot.values[i], other[i])) measured_.set(i);
  for (const Group group : kOpponents) {
    const auto [first, count] = telemetry::fields_of(group);
    for (telemetry::FieldIndex i = first; i < first + count; ++i) measured_.set(i);
  }
  RecordedState state{.at = at, .values = snapshot.values, .groups = {}};
  for (const telemetry::GroupRow& row : telemetry::kGroupTable)
    if (is_recorded(row.group) && snapshot.ever(row.group)) state.groups.add(row.group);
  return state;
}

bool has_base(const RecordedRun& run) {
  return run.metadata(io::BlackBox::kBaseKey) != io::BlackBox::kNoBase;
}

RunFiles files_of(const RecordedRun& run, const RunFiles& given) {
  return {.car = path_of(run, "car", given.car), .track = path_of(run, "track", given.track)};
}

Result<pipeline::Setup, Problem> setup_of(const RecordedRun& run, const RunFiles& files,
                                          std::vector<std::string>& remarks) {
  auto car = car_of(run, files.car, remarks);
  if (!car) return Unexpected{car.error()};
  const auto track_file = file_of(run, "track", files.track, remarks);
  if (!track_file) return Unexpected{track_file.error()};
  const auto track = parameters::read_track(track_file->text, track_file->path);
  if (!track) return Unexpected{track.error()};
  if (!has_base(run)) car->params.watchdog[safety::Stream::kRadio].watched = false;
  const auto read_bank = [&](const std::string& path) -> Result<std::string, Problem> {
    const bool is_recorded = !run.metadata("bank_file").empty();
    auto bank = file_of(run, "bank", is_recorded ? "" : path, remarks);
    if (!bank) return Unexpected{bank.error()};
    return std::move(bank->text);
  };
  return parameters::set_up(*car, *track, read_bank);
}

}  // namespace pitwall::bench
