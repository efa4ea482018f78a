// Judges a recording again and holds the alarms against those that were told then.
//   in     a folder of segments
//   out    how many lists and lines of alarms were compared, which differ
//   invariants
//          what a base has recorded it judges again to the same texts, byte for byte: the same
//          states and inputs, in the same order, at the same times. Each process that recorded is
//          judged on its own clock, with the settings that it had
//   errors Problem where there is no segment; segments that cannot be read are told
//   cost   the grid of the Evaluator: some seconds for each hour
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "basestation/alarms/evaluator.hpp"
#include "basestation/replay/listener.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::service {

class AlarmCheck : public replay::Listener {
 public:
  static constexpr std::size_t kListed = 20;

  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups,
             Instant received) override;
  void text(recorder::Topic topic, Instant at, std::string_view json) override;
  void restart(Instant) override {}

  std::uint64_t lists() const { return lists_; }
  std::uint64_t lines() const { return lines_; }
  std::uint64_t different() const { return different_; }
  const std::vector<std::string>& differences() const { return differences_; }  // the first
  // No base of ours that records what it judges by.
  bool judged() const { return evaluator_.has_value(); }
  const alarms::Evaluator& watch() const { return *evaluator_; }

 private:
  void compare(std::string_view reported, const std::string& again);
  void compare_line(std::string_view reported);

  state::VehicleState vehicle_;
  std::optional<alarms::Evaluator> evaluator_;
  std::uint64_t lists_ = 0, lines_ = 0, different_ = 0, line_ = 0;
  std::vector<std::string> differences_;
};

// The whole folder. Lines for a person in `say`.
Result<AlarmCheck, Problem> check_alarms(const std::string& folder, std::vector<std::string>& say);

}  // namespace pitwall::service
