// Counts of one receiver's bytes and messages since the start of the car process, for telemetry, so
// that every drop is visible. The counts per reason are in the summary of the car.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pitwall::world {

struct ReceiverTraffic {
  std::uint64_t bytes = 0, logs = 0;
  std::uint64_t bad_checksum = 0;
  std::uint64_t bad_frame = 0;  // an unknown header, or one that was not requested
  std::uint64_t resyncs = 0;    // number of gaps with bytes outside logs
  std::uint64_t refused = 0;    // whole logs: content, range, unknown time, faulty IMU
  std::uint64_t lost = 0;       // datagrams lost before the read; losses of a stream
};

}  // namespace pitwall::world
