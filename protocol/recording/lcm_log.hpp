// Event log of LCM (lcm-logger, lcm-logplayer): writer to a sink, reader from memory.
//   wire   for each event, numbers with the most significant byte first: sync word EDA1DA01, event
//          number i64, time i64 (us since 1970), length of the channel i32, length of the data i32,
//          then both
//   invariants
//          the writer counts events from 0; the reader returns them in the order of the file. After
//          damage the reader continues at the next sync word with a whole event. The event directly
//          before the damage is lost too, because no sync word follows it
//   errors writer: a channel name that LCM does not allow (empty, or over 63 bytes), data over
//          kLcmDataMax or a negative time is refused and counted; after a failure of the sink
//          everything is refused
//          reader: bytes between events are counted as skipped; a cut event at the end is not
//          returned
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
inline constexpr std::size_t kLcmHeadBytes = 4 + 8 + 8 + 4 + 4;  // before the channel
inline constexpr std::size_t kLcmChannelMax = 63;
inline constexpr std::size_t kLcmDataMax = std::size_t{1} << 26;  // far above our messages

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

  // False: refused and counted by reason.
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

  // The next event; nullopt at the end of the file.
  std::optional<LcmEvent> next();
  std::uint64_t events() const { return events_; }
  std::uint64_t bytes_skipped() const { return skipped_; }  // bytes in no event

 private:
  std::optional<LcmEvent> event_here();

  std::span<const std::uint8_t> rest_;
  std::uint64_t events_ = 0, skipped_ = 0;
};

}  // namespace pitwall::recording
