// Counters of a receiver's bytes and messages by result: every message that is not used is counted
// with its reason.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/gnss/refusal.hpp"
#include "protocol/gnss/stream_window.hpp"
#include "vehicle/receivers/gps_clock.hpp"
#include "vehicle/world/receiver.hpp"

namespace pitwall::receivers {

struct Counters {
  // Byte stream.
  std::uint64_t bytes = 0, frames = 0;
  std::uint64_t garbage_bytes = 0;  // not part of a frame
  std::uint64_t resyncs = 0;        // number of gaps with garbage
  std::uint64_t bad_checksum = 0;
  std::uint64_t bad_frame = 0;  // an unknown header, or one that was not requested
  // Whole frames.
  std::uint64_t unused = 0;        // known messages that the car does not need
  gnss::Refusals refused;          // by the decoder, per reason
  std::uint64_t time_unknown = 0;  // the receiver has no time yet
  std::uint64_t out_of_range = 0;  // impossible position or speed
  std::uint64_t imu_error = 0;     // flagged by the IMU, or an IMU type of unknown scale
  std::array<std::uint64_t, kStreams> samples{};    // passed on, per stream
  std::uint64_t health = 0;                         // status messages of the receiver
  std::array<std::uint64_t, kStampFlaws> stamps{};  // of passed-on samples, per flaw
  std::uint64_t clock_steps = 0;                    // accepted steps of the receiver's time
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

// Counters for telemetry. The receiver's port adds what was lost before it.
inline world::ReceiverTraffic traffic_of(const Counters& c) {
  return {.bytes = c.bytes,
          .logs = c.frames,
          .bad_checksum = c.bad_checksum,
          .bad_frame = c.bad_frame,
          .resyncs = c.resyncs,
          .refused = c.refused.total() + c.time_unknown + c.out_of_range + c.imu_error};
}

}  // namespace pitwall::receivers
