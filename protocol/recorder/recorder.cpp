// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/recorder.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "protocol/bits/sha256.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/recorder/can_record.hpp"
#include "protocol/telemetry/registry/schema.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::recorder {
namespace {

constexpr Duration kTurn = milliseconds(100);
constexpr double kSecondsPerMinute = 60.0;
constexpr const char* kBootId = "/proc/sys/kernel/random/boot_id";

ChainParams params_of(recording::Metadata run, const ClockMap& clock) {
  ChainParams params;
  params.run = std::move(run);
  params.clock = clock;
  return params;
}

}  // namespace

ClockMap clock_now() {
  std::string boot = transport::read_file(kBootId).value_or("unknown");
  while (!boot.empty() && boot.back() == '\n') boot.pop_back();
  return {.utc_minus_base = transport::realtime_minus_monotonic(), .boot = boot};
}

recording::Metadata program_metadata(const std::string& program) {
  std::array<char, 20> schema{};
  std::snprintf(schema.data(), schema.size(), "%016llx",
                static_cast<unsigned long long>(telemetry::kSchemaHash));
  return {{"program", program}, {"revision", PITWALL_REVISION}, {"schema", schema.data()}};
}

void append_file(recording::Metadata& run, const std::string& key, const std::string& path) {
  if (path.empty()) return;
  if (const auto text = transport::read_file(path)) return append_text(run, key, path, *text);
  run.emplace_back(key + "_file", path);
}

void append_text(recording::Metadata& run, const std::string& key, const std::string& path,
                 const std::string& text) {
  if (path.empty()) return;
  run.emplace_back(key + "_file", path);
  bits::Sha256 hash;
  hash.update(as_bytes(text));
  run.emplace_back(key + "_sha256", bits::to_hex(hash.digest()));
}

double RecorderFigures::minutes_left() const {
  if (!(bytes_per_s > 0.0)) return kUnset;
  return static_cast<double>(free_bytes) / bytes_per_s / kSecondsPerMinute;
}

Result<std::unique_ptr<Recorder>, Problem> Recorder::start(const std::string& folder,
                                                           recording::Metadata run) {
  std::unique_ptr<Recorder> recorder{new Recorder{folder, std::move(run), clock_now()}};
  if (const auto problem = recorder->disk_.check()) return Unexpected{*problem};
  return recorder;
}

Recorder::Recorder(const std::string& folder, recording::Metadata run, ClockMap clock)
    : clock_(std::move(clock)),
      started_(transport::monotonic_now()),
      disk_(folder),
      lcm_disk_(folder),
      chain_(disk_, params_of(std::move(run), clock_), &lcm_disk_),
      writer_([this] { write_all(); }) {}

Recorder::~Recorder() {
  queue_.close();
  writer_.join();
}

void Recorder::state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
                     Instant received) {
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    if (!groups.has(row.group) || !state.ever(row.group)) continue;
    const GroupBytes bytes = encode(row.group, state.values);
    queue_.push({.channel = channel_of(row.group),
                 .logged = received,
                 .published = state.at(row.group),
                 .data = bytes.span()});
  }
}

void Recorder::text(Topic topic, Instant at, std::string_view json) {
  queue_.push(
      {.channel = channel_of(topic), .logged = at, .published = at, .data = as_bytes(json)});
}

void Recorder::datagram(bool down, Instant at, const RadioDatagram& datagram) {
  DatagramBytes bytes;
  raw(down ? kDownChannel : kUpChannel, at, encode(datagram, bytes));
}

void Recorder::receiver(std::size_t unit, Instant at, std::span<const std::uint8_t> bytes) {
  CHECK(unit < kReceivers);
  raw(static_cast<std::uint16_t>(kReceiverChannel + unit), at, bytes);
}

void Recorder::raw(std::uint16_t channel, Instant at, std::span<const std::uint8_t> bytes) {
  const double grown = std::max(0.0, (at - raw_at_).seconds()) * kRawBytesPerSecond;
  raw_room_bytes_ = std::min(kRawBurstBytes, raw_room_bytes_ + grown);
  raw_at_ = std::max(raw_at_, at);
  const auto size = static_cast<double>(bytes.size());
  if (size > raw_room_bytes_) {
    left_out_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  raw_room_bytes_ -= size;
  queue_.push({.channel = channel, .logged = at, .published = at, .data = bytes});
}

void Recorder::write_all() {
  Batch batch;
  for (bool more = true; more;) {
    more = queue_.take_all(batch, kTurn);
    const Instant now = transport::monotonic_now();
    while (const auto record = batch.next()) chain_.take(*record, now);
    chain_.turn(now);
    if (!more) chain_.close();
    const std::lock_guard lock{mutex_};
    reported_ = chain_.figures();
  }
}

void Recorder::can(bool out, Instant at, const can::Frame& frame) {
  CanBytes bytes;
  queue_.push({.channel = out ? kCanOutChannel : kCanInChannel,
               .logged = at,
               .published = at,
               .data = encode(frame, bytes)});
}

void Recorder::tick(Instant at, const TickRecord& tick) {
  TickBytes bytes;
  queue_.push({.channel = kTickChannel,
               .logged = at,
               .published = at,
               .data = recording::to_cdr(tick, bytes)});
}

RecorderFigures Recorder::figures() const {
  RecorderFigures figures;
  {
    const std::lock_guard lock{mutex_};
    figures.chain = reported_;
  }
  figures.dropped = queue_.dropped();
  figures.left_out = left_out_.load(std::memory_order_relaxed);
  figures.syncs = disk_.syncs();
  figures.failed_syncs = disk_.failed_syncs();
  figures.longest_sync = disk_.longest_sync();
  figures.free_bytes = disk_.free_bytes();
  const double run_s = (transport::monotonic_now() - started_).seconds();
  if (run_s > 1.0) figures.bytes_per_s = static_cast<double>(figures.bytes()) / run_s;
  return figures;
}

std::string json_of(const RecorderFigures& figures, Instant now) {
  return json::Object{}
      .text("type", "recorder")
      .number("time_ms", now.ns / 1'000'000)
      .flag("recording", figures.chain.recording)
      .text("segment", figures.chain.segment)
      .number("records", figures.chain.records)
      .number("dropped", figures.dropped)
      .number("left_out", figures.left_out)
      .number("lost", figures.chain.lost)
      .number("lcm_events", figures.chain.lcm.events)
      .number("lcm_lost", figures.chain.lcm.lost)
      .number("interruptions", figures.chain.interruptions)
      .text("problem", figures.chain.problem)
      .number("bytes_per_s", figures.bytes_per_s)
      .number("minutes_left", figures.minutes_left())
      .number("longest_sync_ms", figures.longest_sync.milliseconds())
      .number("failed_syncs", figures.failed_syncs)
      .str();
}

}  // namespace pitwall::recorder
