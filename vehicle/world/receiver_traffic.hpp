// Counts of one receiver's bytes and messages since the car's process began, as the pit wall gets
// them, so that no drop is hidden. The reasons one by one are in the car's summary.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pitwall::world {

struct ReceiverTraffic {
  std::uint64_t bytes = 0, logs = 0;
  std::uint64_t bad_checksum = 0;
  std::uint64_t bad_frame = 0;  // a header that the format does not know, or nobody asked for
  std::uint64_t resyncs = 0;    // times that bytes were in no log
  std::uint64_t refused = 0;    // whole logs: contents, range, unknown time, faulty IMU
  std::uint64_t lost = 0;       // datagrams before they were read; times that a stream was lost
};

}  // namespace pitwall::world
