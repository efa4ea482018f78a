// Status messages with counter and checksum, as no car of ours has them: spoken beside those of the
// car, so that its checks of integrity are asked on its own bus.
//   in     now
//   out    the frames that are due, protected; the rows by which they are to be judged
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

namespace pitwall::revision {

inline constexpr std::size_t kProtectedMessages = 4;

// In the order of their ids; valid for ever.
std::span<const can::MessageRow> protected_rows();
const can::MessageRow* protected_row(std::uint32_t id);  // nullptr: none of them

class ProtectedMessages {
 public:
  FixedVector<can::Frame, kProtectedMessages> due(Instant now);

 private:
  std::array<can::ProtectState, kProtectedMessages> states_{};
  std::array<Instant, kProtectedMessages> due_{};
  std::uint32_t content_ = 0;  // changes with every frame
};

}  // namespace pitwall::revision
