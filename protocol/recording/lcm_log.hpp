// The event log of LCM (lcm-logger, lcm-logplayer): written through a sink, read from memory.
//   wire   for each event, numbers with the most significant byte first: sync word EDA1DA01, event
//          number i64, time i64 (us since 1970), length of the channel i32, length of the data i32,
//          then both
//   invariants
//          the writer counts events from 0; the reader hands them out in the order of the file.
//          Behind damage it goes on at the next sync word from which a whole event follows; the
//          event in front of the damage is lost with it, for what follows it is no sync word
//   errors writer: a channel that LCM does not carry (none, or over 63 bytes), data over
//          kLcmDataMax or a negative time is refused and counted; once the sink has failed
//          everything is
//          reader: bytes between events are counted as skipped; a cut event at the end is not
//          handed out
//   cost   O(bytes); the writer keeps one event in memory
//   source lcm/eventlog.c of LCM 1.3.1; LCM_MAX_CHANNEL_NAME_LENGTH of lcm/lcm.h
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "protocol/recording/mcap_writer.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::recording {

inline constexpr std::uint32_t kLcmSync = 0xEDA1DA01;
inline constexpr std::size_t kLcmHeadBytes = 4 + 8 + 8 + 4 + 4;  // in front of the channel
inline constexpr std::size_t kLcmChannelMax = 63;
inline constexpr std::size_t kLcmDataMax = std::size_t{1} << 26;  // no message of ours comes near

struct LcmEvent {
  std::int64_t number = 0;
  UtcTime at{};  // whole microseconds
  std::string_view channel;
  std::span<const std::uint8_t> data;
};

class LcmLogWriter {
 public:
  struct Counters {
    std::uint64_t events = 0, bytes = 0;
    std::uint64_t refused_channel = 0, refused_size = 0, refused_time = 0, refused_sink = 0;
  };

  explicit LcmLogWriter(Sink sink) : sink_(std::move(sink)) {}

  // False: refused, and counted by its reason.
  bool write(UtcTime at, std::string_view channel, std::span<const std::uint8_t> data);
  const Counters& counters() const { return counters_; }

 private:
  Sink sink_;
  Counters counters_;
  std::vector<std::uint8_t> event_;
  bool failed_ = false;
};

class LcmLogReader {
 public:
  explicit LcmLogReader(std::span<const std::uint8_t> file) : rest_(file) {}

  // The next event, or none at the end of the file.
  std::optional<LcmEvent> next();
  std::uint64_t events() const { return events_; }
  std::uint64_t bytes_skipped() const { return skipped_; }  // that are part of no event

 private:
  std::optional<LcmEvent> event_here();

  std::span<const std::uint8_t> rest_;
  std::uint64_t events_ = 0, skipped_ = 0;
};

}  // namespace pitwall::recording
