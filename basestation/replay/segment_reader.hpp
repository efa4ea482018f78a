// One segment of a recording as the calls of a Listener, from front to back.
//   in     the bytes of a file, which must outlive the reader; the clock on which it tells times
//   out    step(): one message each; where the file has a picture, restore() tells all of it
//   invariants
//          values, groups and times are those that the live base had, to the bit
//   errors a file that is cut or damaged tells what can be read of it; messages that are no sample
//          of their channel, and texts of no known type, are counted
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
  // `known`: what the segments before have told, and goes on here.
  SegmentReader(std::span<const std::uint8_t> file, const recorder::ClockMap& clock,
                telemetry::Snapshot& known);

  // When the next message was received; none at the end of the file.
  std::optional<Instant> due();
  // Tells it, and goes on.
  void step(Listener& listener);
  // Goes to the last picture that is not newer and tells it; then all up to that time is told with
  // step(). False: the file has none, and stands where it stood.
  bool restore(Instant at, Listener& listener);
  // Goes on to the first message that is not older.
  void skip_to(Instant at);
  std::uint64_t unreadable() const { return unreadable_; }

 private:
  // A channel of the file: its sample fields, or the type of its texts; or of no interest.
  struct Place {
    std::optional<recorder::ChannelFields> fields;
    std::optional<recorder::Topic> topic;
  };

  const Place& place_of(std::uint16_t channel);
  Instant to_base(std::uint64_t file_ns) const;
  void tell_state(const Place& place, Listener& listener);
  void tell_picture(const recorder::Known& vehicle, Instant at, Listener& listener);

  std::span<const std::uint8_t> file_;
  recorder::ClockMap clock_;
  telemetry::Snapshot& known_;
  recording::McapReader reader_;
  std::map<std::uint16_t, Place> places_;
  std::optional<recording::McapMessage> next_;
  std::uint64_t unreadable_ = 0;
};

}  // namespace pitwall::replay
