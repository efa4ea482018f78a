// Proof that each monitor is needed: without it, a scenario fails by the behaviour of the car, in a
// run that ignores what the monitors report.
//   in     loaded scenarios that pass with every monitor; a monitor
//   out    for each scenario that requires the monitor, the first expectation that fails without it
//   invariants
//          no `seen_...` signal counts, of this monitor or another: a fault that is only reported
//          proves nothing. A contact that the scenario does not expect counts
//   errors Problem of a scenario
//   cost   a run ends at the first expectation that fails
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hil/bench/loading.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/monitor.hpp"

namespace pitwall::fault_coverage {

// A monitor that does not change the behaviour of the car, with its purpose.
struct InformsOnly {
  world::Monitor monitor;
  std::string_view reason;
};

inline constexpr std::size_t kInformsOnlyMax = 4;
inline constexpr std::array kInformsOnly{
    InformsOnly{world::Monitor::kBusLoad,
                "a full bus harms by late messages alone, and message_age acts on those; the load "
                "tells the operator whose fault they are"},
    InformsOnly{world::Monitor::kFlagAgreement,
                "of two flags that differ the car follows the stricter and of an unknown one it "
                "stops, whoever notices; the operator has to ask race control"},
};
static_assert(kInformsOnly.size() <= kInformsOnlyMax);

constexpr const InformsOnly* informs_only(world::Monitor monitor) {
  for (const InformsOnly& row : kInformsOnly)
    if (row.monitor == monitor) return &row;
  return nullptr;
}
static_assert(informs_only(world::Monitor::kChecksum) == nullptr &&
                  informs_only(world::Monitor::kClock) == nullptr &&
                  informs_only(world::Monitor::kTiming) == nullptr &&
                  informs_only(world::Monitor::kFrameShape) == nullptr &&
                  informs_only(world::Monitor::kModule) == nullptr,
              "the car acts on what these see");

// True if the scenario has a `detects` expectation for this monitor.
bool asks(const scenario::Scenario& scenario, world::Monitor monitor);

// True if the expectation is about the behaviour of the car, not about its monitors.
bool is_consequence(const grading::Expectation& expectation);

struct Consequence {
  std::string scenario, expectation, reason;
};

// What fails without the monitor; nullopt: the scenario passes without it.
Result<std::optional<Consequence>, Problem> consequence_without(world::Monitor monitor,
                                                                const bench::Loaded& loaded);

struct Proof {
  world::Monitor monitor{};
  std::vector<std::string> asked;     // scenarios that require the monitor
  std::vector<Consequence> failed{};  // at most one per scenario

  bool proven() const { return !failed.empty(); }
};

// What remains to be fixed; empty: the monitor is proven, or informs only.
std::string open_point(const Proof& proof);

std::string to_text(const std::vector<Proof>& proofs);
std::string json_of(const Proof& proof);

}  // namespace pitwall::fault_coverage
