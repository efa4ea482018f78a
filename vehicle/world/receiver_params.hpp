// Parameters of one satellite receiver (GNSS with IMU), as the car file gives them.
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

}  // namespace pitwall::world
