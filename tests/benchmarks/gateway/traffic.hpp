// Three saturated buses' worth of periodic frames, with single frames left out on purpose: what the
// gateway is loaded with. Sender, receivers and judge make the same traffic from the same numbers.
//   in     how long, how many frames to leave out, a seed
//   out    streams (one per message), the frames due at each millisecond, what was left out
//   units  Duration since the start of the traffic, whole milliseconds
//   invariants
//          the frames of all milliseconds and the omissions are the whole schedule, each once; a
//          counter counts omitted frames too (they were lost on their way)
//   cost   frames_due(): O(streams)
//
// The car's own rest bus is in it with its periods and counters (about 1,044 frames/s); the others
// have identifiers that no database knows, one period for all, every second one with a counter.
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

inline constexpr Duration kBatch = milliseconds(1);  // all that falls due in it goes out at once

// The first 256 foreign identifiers, which one kernel filter can select. In data bytes 4 to 7 their
// frames carry a running number over the whole group, in the order of sending.
inline constexpr std::uint32_t kNumberedId = 0x100, kNumberedMask = 0x700;
constexpr bool is_numbered(std::uint32_t id) { return (id & kNumberedMask) == kNumberedId; }
std::uint32_t number_of(const can::Frame& frame);

struct Stream {
  can::MessageRow row;
  Duration phase{};     // of the first frame
  bool of_car = false;  // in the car's database
};

struct TrafficPlan {
  Duration length = seconds(60);
  std::size_t omissions = 0;
  std::uint64_t seed = 1;
  Duration foreign_period = milliseconds(10);  // three saturated buses' worth; 30 ms: one's
};

struct Omission {
  std::size_t stream = 0;
  std::uint32_t index = 0;  // of the frame in its stream
  Duration due{};
};

class Traffic {
 public:
  explicit Traffic(const TrafficPlan& plan);

  std::span<const Stream> streams() const { return streams_; }
  std::optional<std::size_t> stream_of(std::uint32_t id) const;
  std::span<const Omission> omissions() const { return omissions_; }  // sorted by (stream, index)
  Duration length() const { return length_; }
  // Frames of the whole schedule, and of these how many are sent.
  std::uint64_t scheduled() const { return scheduled_; }
  std::uint64_t sent() const { return scheduled_ - omissions_.size(); }
  std::uint64_t sent_of_car() const;
  std::uint64_t sent(std::size_t stream) const;
  Duration last_due(std::size_t stream) const;

  // What is sent at `at`, in the order of the streams, appended. Call it for every batch in turn.
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
