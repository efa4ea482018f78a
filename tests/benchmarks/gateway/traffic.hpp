// CAN load of the gateway benchmark: the periodic frames of three saturated buses, with single
// frames omitted on purpose. Sender, receivers and judge compute the same traffic from one seed.
//   in     length, number of frames to omit, a seed
//   out    streams (one per message), the frames due at each millisecond, the omissions
//   units  Duration since the start of the traffic, whole milliseconds
//   invariants
//          the frames of all milliseconds and the omissions together are the whole schedule, each
//          once; a message counter also counts omitted frames, as if they were lost on the bus
//   cost   frames_due(): O(streams)
//
// It contains the rest bus of the car with its periods and counters (about 1,044 frames/s). The
// other streams have identifiers that are in no database and a common period; every second one has
// a counter.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "protocol/can/frame.hpp"
#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::load {

inline constexpr Duration kBatch = milliseconds(1);  // frames due in it are sent at once

// The first 256 foreign identifiers, which one kernel filter selects. Data bytes 4 to 7 of their
// frames are a running number over the whole group, in the order of sending.
inline constexpr std::uint32_t kNumberedId = 0x100, kNumberedMask = 0x700;
constexpr bool is_numbered(std::uint32_t id) { return (id & kNumberedMask) == kNumberedId; }
std::uint32_t number_of(const can::Frame& frame);

struct Stream {
  can::MessageRow row;
  Duration phase{};     // due time of the first frame
  bool of_car = false;  // in the car's database
};

struct TrafficPlan {
  Duration length = seconds(60);
  std::size_t omissions = 0;
  std::uint64_t seed = 1;
  Duration foreign_period = milliseconds(10);  // the load of three saturated buses; 30 ms: of one
};

struct Omission {
  std::size_t stream = 0;
  std::uint32_t index = 0;  // index of the frame in its stream
  Duration due{};
};

class Traffic {
 public:
  explicit Traffic(const TrafficPlan& plan);

  std::span<const Stream> streams() const { return streams_; }
  std::optional<std::size_t> stream_of(std::uint32_t id) const;
  std::span<const Omission> omissions() const { return omissions_; }  // sorted by (stream, index)
  Duration length() const { return length_; }
  // Number of frames in the whole schedule, and number of those that are sent.
  std::uint64_t scheduled() const { return scheduled_; }
  std::uint64_t sent() const { return scheduled_ - omissions_.size(); }
  std::uint64_t sent_of_car() const;
  std::uint64_t sent(std::size_t stream) const;
  Duration last_due(std::size_t stream) const;

  // Appends the frames to send at `at` in the order of the streams. Call it for every batch in
  // turn.
  void frames_due(Duration at, std::vector<can::Frame>& out);

 private:
  std::uint32_t count_of(const Stream& stream) const;
  void omit(std::size_t stream, std::uint32_t index);
  bool is_omitted(std::size_t stream, std::uint32_t index) const;
  bool may_omit(std::size_t stream, std::uint32_t index) const;
  void choose_omissions(const TrafficPlan& plan);

  Duration length_;
  std::vector<Stream> streams_;
  std::vector<std::size_t> by_id_;
  std::vector<Omission> omissions_;
  std::uint64_t scheduled_ = 0;
  std::uint32_t number_ = 0;
};

}  // namespace pitwall::load
