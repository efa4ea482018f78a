// State of one stream of samples (one source of one unit) between ticks.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/localization/checks/check_table.hpp"
#include "vehicle/autonomy/localization/checks/stamp_watch.hpp"
#include "vehicle/autonomy/localization/checks/trust.hpp"
#include "vehicle/autonomy/localization/evidence.hpp"

namespace pitwall::localization {

struct Stream {
  Gate verdict = Gate::kUnknown;  // of its newest sample; kSilent without samples
  world::MonitorSet seen{};       // monitors with a finding on that sample
  Trust trust;
  std::uint8_t jumps_in_row = 0;
  StampWatch stamps;
  Instant stamped_at{};  // time of the last used stamp, on the car's clock
  bool has_content = false;
  Content content{};
  // Of the newest sample with valid form, time and solution, for comparison with the other unit.
  bool comparable = false;
  Instant residual_at{};
  std::array<double, 3> residual{};
  double residual_sigma = kUnset, stray = kUnset, rank = kUnset;
};
static_assert(std::is_trivially_copyable_v<Stream>);

using Streams = std::array<std::array<Stream, world::kGnssUnits>, kSources>;

}  // namespace pitwall::localization
