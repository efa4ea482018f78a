// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/lcm_log.hpp"

namespace pitwall::recording {
namespace {

constexpr std::int64_t kNanosecondsPerMicrosecond = 1'000;

void append(std::vector<std::uint8_t>& out, std::uint64_t value, std::size_t bytes) {
  for (std::size_t i = bytes; i-- > 0;) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

std::uint64_t take(std::span<const std::uint8_t>& from, std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) value = value << 8U | from[i];
  from = from.subspan(bytes);
  return value;
}

}  // namespace

bool LcmLogWriter::write(UtcTime at, std::string_view channel, std::span<const std::uint8_t> data) {
  const auto refuse = [](std::uint64_t& counter) { return ++counter, false; };
  if (failed_) return refuse(counters_.refused_sink);
  if (channel.empty() || channel.size() > kLcmChannelMax) return refuse(counters_.refused_channel);
  if (data.size() > kLcmDataMax) return refuse(counters_.refused_size);
  if (at < UtcTime{}) return refuse(counters_.refused_time);
  event_.clear();
  append(event_, kLcmSync, sizeof kLcmSync);
  append(event_, counters_.events, sizeof(std::int64_t));
  append(event_, static_cast<std::uint64_t>(at.ns / kNanosecondsPerMicrosecond),
         sizeof(std::int64_t));
  append(event_, channel.size(), sizeof(std::int32_t));
  append(event_, data.size(), sizeof(std::int32_t));
  event_.insert(event_.end(), channel.begin(), channel.end());
  event_.insert(event_.end(), data.begin(), data.end());
  failed_ = !sink_(event_);
  if (failed_) return refuse(counters_.refused_sink);
  ++counters_.events;
  counters_.bytes += event_.size();
  return true;
}

std::optional<LcmEvent> LcmLogReader::next() {
  while (!rest_.empty()) {
    if (auto event = event_here()) return event;
    rest_ = rest_.subspan(1);
    ++skipped_;
  }
  return std::nullopt;
}

std::optional<LcmEvent> LcmLogReader::event_here() {
  if (rest_.size() < kLcmHeadBytes) return std::nullopt;
  std::span<const std::uint8_t> from = rest_;
  if (take(from, sizeof kLcmSync) != kLcmSync) return std::nullopt;
  LcmEvent event;
  event.number = static_cast<std::int64_t>(take(from, sizeof(std::int64_t)));
  const auto at_us = static_cast<std::int64_t>(take(from, sizeof(std::int64_t)));
  const std::uint64_t channel = take(from, sizeof(std::int32_t));
  const std::uint64_t data = take(from, sizeof(std::int32_t));
  const bool possible = at_us >= 0 && at_us <= INT64_MAX / kNanosecondsPerMicrosecond &&
                        channel > 0 && channel <= kLcmChannelMax && data <= kLcmDataMax;
  if (!possible || channel + data > from.size()) return std::nullopt;
  // As liblcm has it: what is not followed by another event is none.
  std::span<const std::uint8_t> after = from.subspan(channel + data);
  if (after.size() >= sizeof kLcmSync && take(after, sizeof kLcmSync) != kLcmSync) {
    return std::nullopt;
  }
  event.at = {at_us * kNanosecondsPerMicrosecond};
  event.channel = {reinterpret_cast<const char*>(from.data()), channel};
  event.data = from.subspan(channel, data);
  rest_ = from.subspan(channel + data);
  ++events_;
  return event;
}

}  // namespace pitwall::recording
