// Check of a recording: evaluates the alarms again and compares them with the recorded ones.
//   in     a folder of segments
//   out    the number of lists and lines of alarms that were compared, and the differences
//   invariants
//          a recording of a base evaluates to the same texts, byte for byte: the same states and
//          inputs, in the same order, at the same times. Each process that recorded is evaluated
//          on its own clock, with its own settings
//   errors Problem if there is no segment; segments that cannot be read are reported in `log`
//   cost   the grid of the Evaluator: some seconds for each recorded hour
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
  const std::vector<std::string>& differences() const { return differences_; }  // at most kListed
  // False if the recording has no inputs of the evaluator.
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

// Checks the whole folder. `log`: lines for the log.
Result<AlarmCheck, Problem> check_alarms(const std::string& folder, std::vector<std::string>& log);

}  // namespace pitwall::service
