// Reader of one segment of a recording, as calls of a Listener, from front to back.
//   in     the bytes of a file, which must outlive the reader; the clock for the times
//   out    step(): one message each; restore(): a whole state, if the file has such a record
//   invariants
//          values, groups and times are those of the live base, to the bit
//   errors a truncated or damaged file gives all that can be read of it; messages that are not a
//          sample of their channel, and texts of an unknown type, are counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "basestation/replay/listener.hpp"
#include "protocol/recorder/channels.hpp"
#include "protocol/recording/mcap_reader.hpp"

namespace pitwall::replay {

class SegmentReader {
 public:
  // `known`: the state from earlier segments, which goes on here.
  SegmentReader(std::span<const std::uint8_t> file, const recorder::ClockMap& clock,
                telemetry::Snapshot& known);

  // Receive time of the next message; nullopt at the end of the file.
  std::optional<Instant> due();
  // Gives the next message to the listener.
  void step(Listener& listener);
  // Finds the last record of a whole state that is not newer than `at` and gives it; step() then
  // gives the messages after it. Returns false, at the start of the file, if there is none.
  bool restore(Instant at, Listener& listener);
  // Skips to the first message that is not older than `at`.
  void skip_to(Instant at);
  std::uint64_t unreadable() const { return unreadable_; }

 private:
  // A channel of the file: its sample fields, or the type of its texts; both empty if unused.
  struct Place {
    std::optional<recorder::ChannelFields> fields;
    std::optional<recorder::Topic> topic;
  };

  const Place& place_of(std::uint16_t channel);
  Instant to_base(std::uint64_t file_ns) const;
  void tell_state(const Place& place, Listener& listener);
  void publish_snapshot(const recorder::Known& vehicle, Instant at, Listener& listener);

  std::span<const std::uint8_t> file_;
  recorder::ClockMap clock_;
  telemetry::Snapshot& known_;
  recording::McapReader reader_;
  std::map<std::uint16_t, Place> places_;
  std::optional<recording::McapMessage> next_;
  std::uint64_t unreadable_ = 0;
};

}  // namespace pitwall::replay
