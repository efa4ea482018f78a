// Editor of limits, alarms and the radio budget during a race.
//   in     a change with its reason and its author; whether the author holds the authority
//   out    the change in force; a revision that counts up; audit lines, also of refusals
//   invariants
//          a change is stored first and then takes effect; if the disk refuses it, it is not made.
//          Every change needs the authority and a reason
//          the budget is never more than the base was started with
//   errors Problem with the alarm, the field or the budget as place
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "basestation/alarms/evaluator.hpp"
#include "basestation/command/audit.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::command {

// kbit/s up each radio path.
struct UpBudget {
  double least = 64.0, most = kUnset;
  double now = kUnset;
};

class SettingsEditor {
 public:
  struct Wanted {
    const state::DeriveParams& derive;
    const alarms::Limits& limits;
    const alarms::AlarmSettings& alarms;
    std::uint64_t revision;
    double up_kbit_s;
  };
  // Stores the settings for the next start. Empty: nothing is stored, and consoles show that.
  using Save = std::function<Result<bool, Problem>(const Wanted&)>;
  struct Origin {
    Person by;
    bool holds_authority = false;
    std::string reason;
    Instant at{};
  };

  SettingsEditor(alarms::Evaluator& evaluator, Audit& audit, std::uint64_t revision,
                 const UpBudget& budget, Save save)
      : evaluator_(&evaluator),
        audit_(&audit),
        revision_(revision),
        budget_(budget),
        save_(std::move(save)) {}

  // The evaluator must be at the time of the change: see Evaluator::advance().
  Result<bool, Problem> change(const Origin& origin, alarms::AlarmEdit edit);
  Result<bool, Problem> change(const Origin& origin, alarms::LimitEdit edit);
  Result<bool, Problem> change_budget(const Origin& origin, double up_kbit_s);

  std::uint64_t revision() const { return revision_; }
  const UpBudget& budget() const { return budget_; }
  bool kept() const { return save_ != nullptr; }

 private:
  Result<bool, Problem> note(const Origin& origin, const std::string& what,
                             Result<bool, Problem> result);
  Result<bool, Problem> allowed(const Origin& origin, const std::string& place) const;
  Result<bool, Problem> save(const alarms::Limits& limits, const alarms::AlarmSettings& alarms,
                             double up_kbit_s);

  alarms::Evaluator* evaluator_;
  Audit* audit_;
  std::uint64_t revision_;
  UpBudget budget_;
  Save save_;
};

}  // namespace pitwall::command
