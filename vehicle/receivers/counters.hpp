// Counters of a receiver's messages, by what became of them: every message that is not used has its
// counter.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/gnss/refusal.hpp"
#include "protocol/gnss/stream_window.hpp"
#include "vehicle/receivers/gps_clock.hpp"
#include "vehicle/world/receiver_traffic.hpp"

namespace pitwall::receivers {

struct Counters {
  // Of the byte stream.
  std::uint64_t bytes = 0, frames = 0;
  std::uint64_t garbage_bytes = 0;  // in no frame
  std::uint64_t resyncs = 0;        // times that garbage began
  std::uint64_t bad_checksum = 0;
  std::uint64_t bad_frame = 0;  // a header that the format does not know, or nobody asked for
  // Of whole frames.
  std::uint64_t unused = 0;        // known messages that the car does not need
  gnss::Refusals refused;          // by the decoder, by reason
  std::uint64_t time_unknown = 0;  // the receiver does not know the time yet
  std::uint64_t out_of_range = 0;  // no place on earth, no speed of a car
  std::uint64_t imu_error = 0;     // flagged by the IMU itself, or a type without scale
  std::array<std::uint64_t, kStreams> samples{};    // given on, by stream
  std::uint64_t health = 0;                         // what the receiver said of itself
  std::array<std::uint64_t, kStampFlaws> stamps{};  // of samples given on, by flaw
  std::uint64_t clock_steps = 0;                    // of the receiver's time, believed
};

inline Counters with_stream(Counters counters, const gnss::StreamCounters& stream) {
  counters.bytes = stream.bytes;
  counters.frames = stream.frames;
  counters.garbage_bytes = stream.garbage_bytes;
  counters.resyncs = stream.resyncs;
  counters.bad_checksum = stream.bad_crc;
  counters.bad_frame = stream.bad_header + stream.oversize + stream.unexpected;
  return counters;
}

// What the pit wall is told of it; what was lost on the way here only the rim knows.
inline world::ReceiverTraffic traffic_of(const Counters& c) {
  return {.bytes = c.bytes,
          .logs = c.frames,
          .bad_checksum = c.bad_checksum,
          .bad_frame = c.bad_frame,
          .resyncs = c.resyncs,
          .refused = c.refused.total() + c.time_unknown + c.out_of_range + c.imu_error};
}

}  // namespace pitwall::receivers
