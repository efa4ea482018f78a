// Operator entries of before a base was killed, restored from its recording: the announced round
// speed, the flag that was relayed, the fuel that was filled in.
//   in     texts `expected` and states of the car, oldest first, with times on the clock of now
//   out    the same entries, with who made them and when; the fuel of them that must be left
//   invariants
//          fuel is reckoned on through the states that were recorded, as the base that was killed
//          did; from the last of them to now the engine is taken to have burnt on as it did then:
//          what nobody heard was burnt, not saved
//   errors a text that cannot be read says nothing
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "basestation/command/request_executor.hpp"
#include "basestation/state/derived/fuel_estimate.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"

namespace pitwall::service {

struct RestoredEntries {
  command::OperatorEntries entries;
  double fuel_left_l = kUnset;
};

class EntriesReader {
 public:
  void expected(std::string_view json, Instant at);
  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups);

  std::optional<RestoredEntries> result(Instant now) const;  // none: nobody had entered anything

 private:
  std::optional<command::OperatorEntries> entries_;
  state::FuelEstimate fuel_;
  state::EngineSample engine_;
  std::optional<Instant> engine_at_;
};

}  // namespace pitwall::service
