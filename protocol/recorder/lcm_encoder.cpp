// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/lcm_encoder.hpp"

#include "protocol/recorder/can_record.hpp"
#include "protocol/recorder/raw_record.hpp"
#include "protocol/telemetry/export/lcm_schema.hpp"

namespace pitwall::recorder {
namespace {

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

void put_datagram(std::vector<std::uint8_t>& out, std::span<const std::uint8_t> record) {
  const RadioDatagram datagram = decode_datagram(record).value_or(RadioDatagram{});
  put(out, std::int16_t{datagram.path});
  put(out, static_cast<std::int32_t>(datagram.ip));
  put(out, std::int32_t{datagram.port});
  put(out, static_cast<std::int32_t>(datagram.bytes.size()));
  put_bytes(out, datagram.bytes);
}

bool is_text(std::uint16_t channel) {
  return channel >= telemetry::kGroups && channel < telemetry::kGroups + kTopics;
}
bool is_air(std::uint16_t channel) { return channel == kDownChannel || channel == kUpChannel; }
bool is_can(std::uint16_t channel) { return channel == kCanInChannel || channel == kCanOutChannel; }

telemetry::LcmType type_of(std::uint16_t channel) {
  if (is_group(channel)) return telemetry::lcm_type(static_cast<telemetry::Group>(channel));
  if (is_text(channel)) return telemetry::lcm_text_type();
  if (is_can(channel)) return telemetry::lcm_can_type();
  return is_air(channel) ? telemetry::lcm_datagram_type() : telemetry::lcm_bytes_type();
}

}  // namespace

LcmEncoder::LcmEncoder(const ClockMap& clock) : utc_of_zero_(clock.to_file(Instant{})) {
  for (const recording::Channel& channel : channels()) {
    const auto place = static_cast<std::uint16_t>(kinds_.size());
    kinds_.push_back({channel.topic, telemetry::lcm_fingerprint(type_of(place))});
  }
}

bool LcmEncoder::has(std::uint16_t channel) const {
  return channel != kSnapshotChannel && channel != kTickChannel && channel < kinds_.size();
}

void LcmEncoder::encode(const Record& record, std::vector<std::uint8_t>& out) const {
  const std::int64_t utc_ns = utc_of_zero_.ns + record.published.ns;
  out.clear();
  put(out, kinds_[record.channel].fingerprint);
  put(out, utc_ns / kNanosecondsPerMicrosecond);
  if (is_group(record.channel)) return put_doubles(out, record.data);
  if (is_can(record.channel)) return put_can(out, record.data);
  if (is_air(record.channel)) return put_datagram(out, record.data);
  // A string has its zero with it.
  const std::size_t zero = is_text(record.channel) ? 1 : 0;
  put(out, static_cast<std::int32_t>(record.data.size() + zero));
  put_bytes(out, record.data);
  if (zero != 0) out.push_back(0);
}

}  // namespace pitwall::recorder
