// A car's own recording as its ticks, in their order: what each was given, what it said and, every
// other time, its state.
//   in     the folder of a black box, or one of its segments
//   out    ticks as the car had them: instants of its clock, frames, bytes of its receivers
//   invariants
//          ticks come without a gap, from the first of the run: a car driven again has its state
//          from the start. A car that was started again begins another run, in a file of its own:
//          the first one ends there, which remarks() tells
//   errors Problem with file or tick: not a car's recording, one from before ticks were recorded, a
//          tick that is missing or of which something is missing. What a killed car left cut off at
//          the end is told by remarks()
//   cost   one segment in memory
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/can/frame.hpp"
#include "protocol/recorder/channels.hpp"
#include "protocol/recorder/tick_record.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench {

struct ReceiverBytes {
  std::size_t unit = 0;
  Instant at{};
  std::vector<std::uint8_t> bytes;
};

struct RecordedState {
  Instant at{};  // when it was made
  telemetry::Values values;
  telemetry::GroupSet groups;
};

struct RecordedTick {
  Instant now{};
  recorder::TickRecord given;
  std::vector<can::ReceivedFrame> received;
  std::vector<ReceiverBytes> receivers;
  std::vector<can::Frame> sent;
  std::optional<RecordedState> state;  // afterwards
};

class RecordedRun {
 public:
  static Result<RecordedRun, Problem> open(const std::string& path);

  // The next tick; none: the recording is over.
  Result<std::optional<RecordedTick>, Problem> next();
  Instant begun() const { return begun_; }  // of the first tick that was read
  // The value of a key that the car wrote in front; empty: it has none.
  std::string metadata(const std::string& key) const;
  const std::vector<std::string>& remarks() const { return remarks_; }
  // Bytes of all segments, and how many of them were read.
  std::size_t size() const { return size_; }
  std::size_t done() const;

 private:
  enum class Kind : std::uint8_t { kOther, kReceived, kSent, kReceiver, kTick, kState };
  struct Place {
    Kind kind = Kind::kOther;
    std::size_t unit = 0;
    std::optional<recorder::ChannelFields> fields;
  };
  struct Segment;  // a file with its reader: the reader refers to the bytes

  Result<bool, Problem> open_next();
  std::optional<recording::McapMessage> next_message();
  const Place& place_of(std::uint16_t channel);
  std::optional<Problem> take(const recording::McapMessage& message);
  std::optional<Problem> take_tick(const recording::McapMessage& message);
  std::optional<Problem> incomplete(const RecordedTick& tick) const;
  Problem problem(const std::string& what) const;
  Instant at(std::uint64_t file_ns) const;

  std::vector<std::string> files_;
  std::size_t opened_ = 0, remarked_ = 0, size_ = 0, done_before_ = 0;
  std::shared_ptr<Segment> segment_;
  std::optional<recording::McapMessage> waiting_;  // of the segment, read already
  recorder::ClockMap clock_;
  std::map<std::uint16_t, Place> places_;
  recording::Metadata run_;
  std::vector<std::string> remarks_;
  RecordedTick collected_;                // what came since the newest tick
  std::optional<RecordedTick> finished_;  // has its record; its state may follow
  bool is_over_ = false;                  // another run begins
  std::uint64_t number_ = 0;              // of the next tick
  Instant begun_{};
};

}  // namespace pitwall::bench
