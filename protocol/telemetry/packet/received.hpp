// Times and path of the packet that carried a record, for the modules that take records.
//   units  own clock; `sent_earliest` is the sender's time of sending on the own clock, minus the
//          bound of the clock comparison: never too late. Empty while the clocks have not been
//          compared
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct Received {
  Instant at{};
  std::optional<Instant> sent_earliest;
  std::uint32_t tx_time_100us = 0;  // of the packet; times in its records are relative to it
  std::uint64_t sequence = 0;
  PathId path = 0;
};

}  // namespace pitwall::telemetry
