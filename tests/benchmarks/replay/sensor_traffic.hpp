// Synthetic bytes of two GNSS receivers beside a CAN log, and the recording that holds both, as the
// black box of a car writes it. The same on every machine.
//
//   receivers  NovAtel, each with position and velocity at 20 Hz and its IMU at 125 Hz, one message
//              per datagram; 330 datagrams a second in all
//   stamps     end of the message plus the latency of line and read; whole microseconds
//
//   in     start and length of the traffic; the CAN log
//   out    datagrams in order of their stamps; an MCAP file with /can/in, /gnss/0 and /gnss/1
//   invariants
//          a recording is in order of its stamps: a frame with an earlier stamp than the one before
//          gets the stamp of that one
//   errors to_recording(): Problem with what the file cannot hold
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/replay/formats/can_log.hpp"
#include "protocol/recorder/channels.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::benchmarks {

inline constexpr std::size_t kReceivers = recorder::kReceivers;

struct SensorDatagram {
  UtcTime at;
  std::size_t receiver = 0;
  std::vector<std::uint8_t> bytes;

  bool operator==(const SensorDatagram&) const = default;
};

std::vector<SensorDatagram> sensor_traffic(UtcTime begin, Duration length);

Result<std::string, Problem> to_recording(const replay::CanLog& log,
                                          const std::vector<SensorDatagram>& datagrams);

}  // namespace pitwall::benchmarks
