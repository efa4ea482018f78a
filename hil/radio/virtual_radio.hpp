// Car and base with the radio between them, in virtual time: both endpoints, both directions of
// each path. For tests, long runs and benchmarks of the protocol. A simulation.
//   in     link parameters by path and direction, budgets, seed; what happens when
//   out    the endpoints, ages at the base as one who looks at them each millisecond would see them
//   law    one seed, one run; time moves in steps of 1 ms
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>

#include "hil/link/link_emulator.hpp"
#include "protocol/telemetry/endpoint/station_endpoint.hpp"
#include "protocol/telemetry/endpoint/car_endpoint.hpp"

namespace pitwall::radio {

struct RadioSetup {
  std::array<link::LinkParams, telemetry::kPaths> down{}, up{};
  std::array<telemetry::BudgetParams, telemetry::kPaths> budget_down{}, budget_up{};
  std::uint8_t paths = 1;
  telemetry::PathPolicy policy = telemetry::PathPolicy::kDuplicate;
  Duration clock_offset{};       // the base's clock minus the car's
  double clock_drift_ppm = 0.0;  // of the base's clock
  std::uint64_t seed = 1;
};

}  // namespace pitwall::radio
