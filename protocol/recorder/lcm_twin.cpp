// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/lcm_twin.hpp"

#include "protocol/recorder/can_record.hpp"
#include "protocol/telemetry/export/lcm_schema.hpp"

namespace pitwall::recorder {
namespace {

constexpr std::size_t kRoom = std::size_t{1} << 20;
constexpr std::int64_t kNanosecondsPerMicrosecond = 1'000;
constexpr unsigned kBitsPerByte = 8;

// LCM writes the most significant byte first.
template <class Number>
void put(std::vector<std::uint8_t>& out, Number number) {
  const auto bits = static_cast<std::uint64_t>(number);
  for (std::size_t i = sizeof number; i-- > 0;) {
    out.push_back(static_cast<std::uint8_t>(bits >> (kBitsPerByte * i)));
  }
}

void put_bytes(std::vector<std::uint8_t>& out, std::span<const std::uint8_t> bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

// The numbers of a sample in CDR, turned around.
void put_doubles(std::vector<std::uint8_t>& out, std::span<const std::uint8_t> cdr) {
  for (std::size_t at = kCdrHeader; at + sizeof(double) <= cdr.size(); at += sizeof(double)) {
    const auto number = cdr.subspan(at, sizeof(double));
    out.insert(out.end(), number.rbegin(), number.rend());
  }
}

void put_can(std::vector<std::uint8_t>& out, std::span<const std::uint8_t> cdr) {
  CanRecord frame;
  if (!recording::from_cdr(cdr, frame)) frame = {};
  put(out, static_cast<std::int32_t>(frame.id));
  for (const bool flag : {frame.extended, frame.remote, frame.fd}) out.push_back(flag ? 1 : 0);
  put(out, static_cast<std::int32_t>(frame.data.size()));
  put_bytes(out, frame.data.span());
}

bool is_group(std::uint16_t channel) { return channel < telemetry::kGroups; }
bool is_text(std::uint16_t channel) {
  return channel >= telemetry::kGroups && channel < telemetry::kGroups + kTopics;
}
bool is_can(std::uint16_t channel) { return channel == kCanInChannel || channel == kCanOutChannel; }

telemetry::LcmType type_of(std::uint16_t channel) {
  if (is_group(channel)) return telemetry::lcm_type(static_cast<telemetry::Group>(channel));
  if (is_text(channel)) return telemetry::lcm_text_type();
  return is_can(channel) ? telemetry::lcm_can_type() : telemetry::lcm_datagram_type();
}

}  // namespace

LcmTwin::LcmTwin(Disk& disk, const ClockMap& clock)
    : disk_(disk), utc_of_zero_(clock.to_file(Instant{})) {
  for (const recording::Channel& channel : channels()) {
    const auto place = static_cast<std::uint16_t>(kinds_.size());
    kinds_.push_back({channel.topic, telemetry::lcm_fingerprint(type_of(place))});
  }
  waiting_.reserve(kRoom);
}

void LcmTwin::begin(const std::string& name) {
  if (disk_.begin(name + ".lcm")) return;
  log_.emplace([this](std::span<const std::uint8_t> event) {
    put_bytes(waiting_, event);
    return true;
  });
}

void LcmTwin::take(const Record& record) {
  if (record.channel == kPictureChannel || record.channel >= kinds_.size()) return;
  if (!log_) {
    ++figures_.lost;
    return;
  }
  encode(record);
  const UtcTime logged{utc_of_zero_.ns + record.logged.ns};
  if (log_->write(logged, kinds_[record.channel].topic, event_)) {
    ++waiting_events_;
  } else {
    ++figures_.lost;
  }
  if (waiting_.size() >= kRoom) flush();
}

void LcmTwin::encode(const Record& record) {
  const std::int64_t utc_ns = utc_of_zero_.ns + record.published.ns;
  event_.clear();
  put(event_, kinds_[record.channel].fingerprint);
  put(event_, utc_ns / kNanosecondsPerMicrosecond);
  if (is_group(record.channel)) return put_doubles(event_, record.data);
  if (is_can(record.channel)) return put_can(event_, record.data);
  // A string has its zero with it.
  const std::size_t zero = is_text(record.channel) ? 1 : 0;
  put(event_, static_cast<std::int32_t>(record.data.size() + zero));
  put_bytes(event_, record.data);
  if (zero != 0) event_.push_back(0);
}

void LcmTwin::flush() {
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

void LcmTwin::end(bool keep) {
  if (keep) flush();
  if (!log_) return;
  figures_.lost += waiting_events_;
  waiting_.clear();
  waiting_events_ = 0;
  log_.reset();
  disk_.end(keep);
}

}  // namespace pitwall::recorder
