// Messages with counter and checksum, which no shipped database has, for tests of the integrity
// checks on a bus of their own: status messages in addition to those of the car, and a checksum in
// the free last byte of race control's flags.
//   in     now; a frame of the bus
//   out    the protected frames that are due; the same frame, with its checksum if it is protected;
//          the rows by which the car checks both
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

// The additional messages, in order of their identifiers; valid forever.
std::span<const can::MessageRow> protected_rows();
const can::MessageRow* protected_row(std::uint32_t id);  // nullptr: not one of them
// The same, and the messages of the car that this bus protects.
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
