// Operator entries from before a base was killed, restored from its recording: the announced round
// speed, the relayed flag, the fuel in the tank.
//   in     texts `expected` and states of the car, oldest first, with times on the present clock
//   out    the same entries, with author and time; how much of their fuel is left
//   invariants
//          fuel use is computed over the recorded states as in the killed base. From the last of
//          them to now, the engine is assumed to have used fuel at the last known rate: time
//          without samples counts as driving, not as standing
//   errors a text that cannot be read is ignored
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "basestation/command/request_executor.hpp"
#include "protocol/rules/fuel.hpp"
#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::service {

struct RestoredEntries {
  command::OperatorEntries entries;
  double fuel_left_l = kUnset;
};

class EntriesReader {
 public:
  void expected(std::string_view json, Instant at);
  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups);

  std::optional<RestoredEntries> result(Instant now) const;  // nullopt: no entries

 private:
  std::optional<command::OperatorEntries> entries_;
  rules::FuelEstimator fuel_;
  rules::EngineSample engine_;
  std::optional<Instant> engine_at_;
};

}  // namespace pitwall::service
