// Reader of a car's own recording, tick by tick: the inputs of each tick, the frames it sent and,
// for every second tick, its state.
//   in     the folder of a black box, or one of its segments
//   out    ticks with instants of the car's clock, frames, bytes of its receivers
//   invariants
//          ticks come without a gap, from the first of the run, so that a replay has the state from
//          the start. A restarted car begins another run in a file of its own: the first run ends
//          there, with a remark
//   errors Problem with file or tick: not a recording of a car, one from before ticks were
//          recorded, a tick that is missing or incomplete. A file that was cut off when the car was
//          killed gives a remark
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
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench {

struct ReceiverBytes {
  std::size_t unit = 0;
  Instant at{};
  std::vector<std::uint8_t> bytes;
};

struct RecordedState {
  Instant at{};  // time of the state
  telemetry::Values values;
  telemetry::GroupSet groups;
};

struct RecordedTick {
  Instant now{};
  recorder::TickRecord given;
  std::vector<can::ReceivedFrame> received;
  std::vector<ReceiverBytes> receivers;
  std::vector<can::Frame> sent;
  std::optional<RecordedState> state;  // after the tick
};

class RecordedRun {
 public:
  static Result<RecordedRun, Problem> open(const std::string& path);

  // The next tick; nullopt at the end of the recording.
  Result<std::optional<RecordedTick>, Problem> next();
  Instant begun() const { return begun_; }  // time of the first tick that was read
  // The metadata of the car for this key; empty if there is none.
  std::string metadata(const std::string& key) const;
  const std::vector<std::string>& remarks() const { return remarks_; }
  // Bytes of all segments, and the number of bytes read so far.
  std::size_t size() const { return size_; }
  std::size_t done() const;

 private:
  enum class Kind : std::uint8_t { kOther, kReceived, kSent, kReceiver, kTick, kState };
  struct Place {
    Kind kind = Kind::kOther;
    std::size_t unit = 0;
    std::optional<recorder::ChannelFields> fields;
  };
  struct Segment;  // a file with its reader, which refers to its bytes

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
  std::optional<recording::McapMessage> waiting_;  // first message of the segment, already read
  recorder::ClockMap clock_;
  std::map<std::uint16_t, Place> places_;
  recording::Metadata run_;
  std::vector<std::string> remarks_;
  RecordedTick collected_;                // inputs and frames since the newest tick
  std::optional<RecordedTick> finished_;  // complete except for the state, which may follow
  bool is_over_ = false;                  // another run has begun
  std::uint64_t number_ = 0;              // number of the next tick
  Instant begun_{};
};

}  // namespace pitwall::bench
