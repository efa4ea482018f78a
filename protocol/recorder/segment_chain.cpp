// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/segment_chain.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <utility>

namespace pitwall::recorder {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 20;
constexpr std::size_t kChunksReserved = 256;  // of a minute in half seconds, and full ones

}  // namespace

SegmentChain::SegmentChain(Disk& disk, ChainParams params, Disk* lcm)
    : disk_(disk), params_(std::move(params)) {
  if (lcm != nullptr) lcm_.emplace(*lcm, params_.clock);
}

SegmentChain::~SegmentChain() { close(); }

void SegmentChain::take(const Record& record, Instant now) {
  now_ = now;
  keep(record);
  if (!is_group(record.channel)) return;
  known_.take(static_cast<telemetry::Group>(record.channel), record.data,
              params_.clock.to_file(record.published));
}

void SegmentChain::keep(const Record& record) {
  if (writer_ && record.logged >= segment_end_) end_segment();
  if (!writer_ && !open(record.logged)) {
    ++figures_.lost;
    return;
  }
  if (record.logged >= snapshot_at_) write_snapshot(record.logged);
  if (!writer_) return;
  if (!put(record)) return fail(disk_.problem());
  if (lcm_) lcm_->take(record);
}

void SegmentChain::turn(Instant now) {
  now_ = now;
  if (!writer_ || now < flush_at_) return;
  flush_at_ = now + params_.chunk;
  if (!flush()) return fail(disk_.problem());
  if (lcm_) lcm_->flush();
}

ChainFigures SegmentChain::figures() const {
  ChainFigures figures = figures_;
  if (lcm_) figures.lcm = lcm_->figures();
  return figures;
}

void SegmentChain::close() {
  if (writer_) end_segment();
  figures_.recording = false;
}

bool SegmentChain::open(Instant stamp) {
  if (retry_at_ && now_ < *retry_at_) return false;
  if (retry_at_ && disk_.free_bytes() < params_.room_to_resume) {
    retry_at_ = now_ + params_.retry;
    return false;
  }
  const std::string name = name_of_segment(UtcTime{params_.clock.to_file(stamp).ns});
  const std::string file = name + ".mcap";
  if (const auto problem = disk_.begin(file)) {
    fail(to_string(*problem));
    return false;
  }
  recording::Metadata run = params_.run;
  run.emplace_back("segment", std::to_string(number_));
  append(run, params_.clock);
  writer_ = std::make_unique<recording::McapWriter>(
      channels(), run, [this](std::span<const std::uint8_t> bytes) { return disk_.append(bytes); },
      recording::McapLimits{
          .chunk_bytes = kChunkBytes, .chunk_span = params_.chunk, .chunks = kChunksReserved});
  waiting_ = 0;
  has_chunk_ = false;
  segment_end_ = stamp + params_.segment;
  flush_at_ = now_ + params_.chunk;
  write_snapshot(stamp);
  if (!writer_) return false;
  if (lcm_) lcm_->begin(name);
  ++number_;
  ++figures_.segments;
  figures_.segment = file;
  figures_.recording = true;
  return true;
}

// NAME_20261122T003000.250Z_00012: in order of time, and of number where clocks are set back.
std::string SegmentChain::name_of_segment(UtcTime at) const {
  namespace chrono = std::chrono;
  const chrono::sys_time<chrono::nanoseconds> time{chrono::nanoseconds{at.ns}};
  const auto day = chrono::floor<chrono::days>(time);
  const chrono::year_month_day date{day};
  const chrono::hh_mm_ss clock{chrono::floor<chrono::milliseconds>(time - day)};
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "_%04d%02u%02uT%02d%02d%02d.%03dZ_%05u",
                static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()), static_cast<int>(clock.hours().count()),
                static_cast<int>(clock.minutes().count()),
                static_cast<int>(clock.seconds().count()),
                static_cast<int>(clock.subseconds().count()), static_cast<unsigned>(number_));
  return params_.name + text.data();
}

// The open segment ends without an index; what the disk has of it can be recovered.
void SegmentChain::fail(std::string problem) {
  figures_.problem = std::move(problem);
  if (!retry_at_) ++figures_.interruptions;
  retry_at_ = now_ + params_.retry;
  figures_.recording = false;
  if (!writer_) return;
  figures_.lost += waiting_;
  figures_.records -= waiting_;
  waiting_ = 0;
  writer_.reset();
  disk_.end(has_chunk_);
  if (lcm_) lcm_->end(has_chunk_);
}

void SegmentChain::end_segment() {
  if (!flush() || !writer_->close()) return fail(disk_.problem());
  writer_.reset();
  disk_.end(true);
  if (lcm_) lcm_->end(true);
}

bool SegmentChain::flush() {
  const std::uint64_t before = writer_->counters().bytes;
  if (!writer_->flush()) return false;
  const recording::McapCounters& after = writer_->counters();
  figures_.bytes += after.bytes - before;
  if (after.chunks != 0) reached_disk(0);
  return true;
}

void SegmentChain::reached_disk(std::uint64_t still_waiting) {
  has_chunk_ = true;
  waiting_ = still_waiting;
  retry_at_.reset();
}

void SegmentChain::write_snapshot(Instant stamp) {
  snapshot_at_ = stamp + params_.snapshot;
  const std::vector<std::uint8_t> bytes = encode(known_);
  const Record record{
      .channel = kSnapshotChannel, .logged = stamp, .published = stamp, .data = bytes};
  if (!put(record)) fail(disk_.problem());
}

// False: the disk has failed.
bool SegmentChain::put(const Record& record) {
  const recording::McapCounters before = writer_->counters();
  const Instant published = std::max(params_.clock.to_file(record.published), Instant{});
  const bool written = writer_->write({record.channel}, params_.clock.to_file(record.logged),
                                      published, record.data);
  const recording::McapCounters& after = writer_->counters();
  figures_.bytes += after.bytes - before.bytes;
  if (after.refused_sink != 0) return false;
  if (after.chunks != before.chunks) reached_disk(0);
  if (written) {
    ++waiting_;
    ++figures_.records;
  } else {
    ++figures_.refused;
  }
  return true;
}

}  // namespace pitwall::recorder
