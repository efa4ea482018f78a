// State and budget of one path at one end.
//   units  bytes per second; sizes are UDP payload, the overhead is added here
//   invariants
//          nothing leaves by the path but through spend()
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/flow/path_budget.hpp"
#include "protocol/telemetry/flow/rate_control.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

class PathLane {
 public:
  // CHECKs what PathBudget::make() would refuse: callers have asked it.
  explicit PathLane(const BudgetParams& params);

  // The rate that the path carries at present, once for each slot.
  void adapt(Instant now);
  // A packet of so many bytes, of them so many safety's, may go.
  bool fits(std::size_t size, std::size_t safety, Instant now) const;
  void spend(std::size_t size, std::size_t safety, Instant now);
  double use(Instant now) const;  // of the whole rate, in the last second

  PathBudget budget;
  RateControl rate;
  double cap = 1.0;                        // of the rate, as its people want it, (0, 1]
  double factor = 1.0;                     // of the rate, by adapt()
  double loss = 0.0;                       // of what came lately by this path
  Instant received_at{};                   // the last arrival by it
  std::uint64_t newest = 0, reported = 0;  // sequence that came by it; of it told the peer
  std::optional<std::uint64_t> proof;      // asked for by the peer

 private:
  std::uint64_t& bytes_in(std::int64_t tenth) {
    return tenths_[static_cast<std::size_t>(tenth) % tenths_.size()];
  }

  std::array<std::uint64_t, 11> tenths_{};  // bytes of the last second and of this tenth
  std::int64_t tenth_ = 0;
};

}  // namespace pitwall::telemetry
