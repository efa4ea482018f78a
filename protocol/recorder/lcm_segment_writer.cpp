// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/lcm_segment_writer.hpp"

namespace pitwall::recorder {
namespace {

constexpr std::size_t kRoom = std::size_t{1} << 20;

}  // namespace

LcmSegmentWriter::LcmSegmentWriter(Disk& disk, const ClockMap& clock)
    : disk_(disk), encoder_(clock) {
  waiting_.reserve(kRoom);
}

void LcmSegmentWriter::begin(const std::string& name) {
  if (disk_.begin(name + ".lcm")) return;
  log_.emplace([this](std::span<const std::uint8_t> event) {
    waiting_.insert(waiting_.end(), event.begin(), event.end());
    return true;
  });
}

void LcmSegmentWriter::take(const Record& record) {
  if (!encoder_.has(record.channel)) return;
  if (!log_) {
    ++figures_.lost;
    return;
  }
  encoder_.encode(record, event_);
  if (log_->write(encoder_.utc(record.logged), encoder_.topic(record.channel), event_)) {
    ++waiting_events_;
  } else {
    ++figures_.lost;
  }
  if (waiting_.size() >= kRoom) flush();
}

void LcmSegmentWriter::flush() {
  if (!log_ || waiting_.empty()) return;
  const bool taken = disk_.append(waiting_);
  (taken ? figures_.events : figures_.lost) += waiting_events_;
  if (taken) figures_.bytes += waiting_.size();
  waiting_.clear();
  waiting_events_ = 0;
  if (taken) return;
  log_.reset();
  disk_.end(true);
}

void LcmSegmentWriter::end(bool keep) {
  if (keep) flush();
  if (!log_) return;
  figures_.lost += waiting_events_;
  waiting_.clear();
  waiting_events_ = 0;
  log_.reset();
  disk_.end(keep);
}

}  // namespace pitwall::recorder
