// Send budget, rate control and state of one radio path at one end.
//   units  bytes per second; sizes are UDP payload, the overhead is added here
//   invariants
//          every packet that is sent on the path is paid by spend()
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
  // CHECKs the parameters, which the caller has validated by PathBudget::make().
  explicit PathLane(const BudgetParams& params);

  // Applies rate control and `cap` to the budget; called once per slot.
  void adapt(Instant now);
  // True if a packet of `size` bytes with `safety` bytes of safety content may be sent.
  bool fits(std::size_t size, std::size_t safety, Instant now) const;
  void spend(std::size_t size, std::size_t safety, Instant now);
  double use(Instant now) const;  // share of the whole rate that was used in the last second

  PathBudget budget;
  RateControl rate;
  double cap = 1.0;                        // share of the rate that the operators allow, (0, 1]
  double factor = 1.0;                     // share of the rate in use, set by adapt()
  double loss = 0.0;                       // share of the packets lost on this path lately
  Instant received_at{};                   // time of the last arrival on it
  std::uint64_t newest = 0, reported = 0;  // newest sequence received on it; last one reported
  std::optional<std::uint64_t> proof;      // token to return to the peer

 private:
  std::uint64_t& bytes_in(std::int64_t tenth) {
    return tenths_[static_cast<std::size_t>(tenth) % tenths_.size()];
  }

  std::array<std::uint64_t, 11> tenths_{};  // bytes per 100 ms: the last second and the current one
  std::int64_t tenth_ = 0;
};

}  // namespace pitwall::telemetry
