// One satellite receiver (GNSS with IMU): its parameters, as the car file gives them, and the
// counts of its traffic since the start of the car process, for telemetry, so that every drop is
// visible. The counts per reason are in the summary of the car.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::world {

enum class ReceiverKind : std::uint8_t { kNovatelOem7, kVectorNav };
inline constexpr std::array<std::string_view, 2> kReceiverKindNames{"novatel_oem7", "vectornav"};

constexpr std::string_view name_of(ReceiverKind kind) {
  return kReceiverKindNames[static_cast<std::size_t>(kind)];
}

struct ReceiverParams {
  ReceiverKind kind = ReceiverKind::kNovatelOem7;
  // Delay of its fastest message, that of the IMU, from measurement to arrival. It is known for the
  // receiver and cannot be derived from its data. 0..0.05 s
  Duration least_delay = milliseconds(2);
};

using Receivers = std::array<ReceiverParams, kGnssUnits>;

struct ReceiverTraffic {
  std::uint64_t bytes = 0, logs = 0;
  std::uint64_t bad_checksum = 0;
  std::uint64_t bad_frame = 0;  // an unknown header, or one that was not requested
  std::uint64_t resyncs = 0;    // number of gaps with bytes outside logs
  std::uint64_t refused = 0;    // whole logs: content, range, unknown time, faulty IMU
  std::uint64_t lost = 0;       // datagrams lost before the read; losses of a stream
};

}  // namespace pitwall::world
