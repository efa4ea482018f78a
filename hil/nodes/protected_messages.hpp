// Messages with checksums, which no shipped database has, for tests of the integrity checks on
// their own bus: status messages with counter and checksum beside those of the car, and a checksum
// in the free last byte of race control's flags.
//   in     now; a frame of the car's own bus
//   out    the frames that are due, protected; the same frame with its checksum, where it has one;
//          the rows by which both are to be judged
//   source protocol/can/dbc/integrity_bench.dbc: SAE J1850 and AUTOSAR profiles 1, 2 and 5
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "protocol/can/e2e.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::can_variant {

inline constexpr std::size_t kProtectedMessages = 4;

// Beside those of the car, in the order of their ids; valid for ever.
std::span<const can::MessageRow> protected_rows();
const can::MessageRow* protected_row(std::uint32_t id);  // nullptr: none of them
// Those, and the messages of the car that this bus protects.
std::span<const can::MessageRow> judged_rows();

can::Frame with_checksum(const can::Frame& frame);

class ProtectedMessages {
 public:
  FixedVector<can::Frame, kProtectedMessages> due(Instant now);

 private:
  std::array<can::ProtectState, kProtectedMessages> states_{};
  std::array<Instant, kProtectedMessages> due_{};
  std::uint32_t content_ = 0;  // changes with every frame
};

}  // namespace pitwall::can_variant
