// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/settings_editor.hpp"

#include <cmath>
#include <utility>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::command {
namespace {

using Done = Result<bool, Problem>;

std::string in_figures(double value) {
  if (std::isnan(value)) return "none";
  return formatted("%g", value);
}

// " limit 0.08 -> 0.1" where it changes.
std::string moved(const char* name, double from, double to) {
  if (from == to || (std::isnan(from) && std::isnan(to))) return {};
  return std::string{" "} + name + " " + in_figures(from) + " -> " + in_figures(to);
}

std::string difference(const alarms::AlarmSetting& from, const alarms::AlarmSetting& to) {
  std::string text;
  if (from.priority != to.priority) {
    text = " priority " + std::string{text_of(from.priority)} + " -> " +
           std::string{text_of(to.priority)};
  }
  return text + moved("limit", from.limit, to.limit) +
         moved("deadband", from.deadband, to.deadband) +
         moved("on_s", from.on_delay.seconds(), to.on_delay.seconds()) +
         moved("off_s", from.off_delay.seconds(), to.off_delay.seconds());
}

// "3 4", "none".
std::string members(std::uint64_t set) {
  std::string text;
  for (unsigned value = 0; set != 0; ++value, set >>= 1U) {
    if ((set & 1U) != 0) text += (text.empty() ? "" : " ") + std::to_string(value);
  }
  return text.empty() ? "none" : text;
}

std::string moved(const char* name, std::uint64_t from, std::uint64_t to) {
  if (from == to) return {};
  return std::string{" "} + name + " " + members(from) + " -> " + members(to);
}

std::string difference(const alarms::Limit& from, const alarms::Limit& to) {
  return moved("warning_low", from.warning_low, to.warning_low) +
         moved("warning_high", from.warning_high, to.warning_high) +
         moved("bad_low", from.bad_low, to.bad_low) +
         moved("bad_high", from.bad_high, to.bad_high) +
         moved("warning_values", from.warning_values, to.warning_values) +
         moved("bad_values", from.bad_values, to.bad_values);
}

}  // namespace

Done SettingsEditor::change(const Origin& origin, alarms::AlarmEdit edit) {
  edit.author = origin.by.name;
  edit.reason = origin.reason;
  std::string what = "alarm " + edit.key;
  if (const auto may = allowed(origin, edit.key); !may) return note(origin, what, may);
  if (const auto index = alarms::find_alarm(edit.key)) {
    what += difference(evaluator_->alarms().settings().of(*index), edit.setting);
  }
  alarms::AlarmSettings wanted = evaluator_->alarms().settings();
  auto done = wanted.edit(edit);
  if (done) done = save(evaluator_->limits(), wanted, budget_.now);
  if (done) done = evaluator_->edit(edit);
  return note(origin, what, std::move(done));
}

Done SettingsEditor::change(const Origin& origin, alarms::LimitEdit edit) {
  edit.author = origin.by.name;
  edit.reason = origin.reason;
  std::string what = "limits of " + state::path_of(edit.field);
  if (const auto may = allowed(origin, state::path_of(edit.field)); !may) {
    return note(origin, what, may);
  }
  if (state::is_field(edit.field)) {
    what += difference(evaluator_->limits().of(edit.field), edit.limit);
  }
  alarms::Limits wanted = evaluator_->limits();
  auto done = wanted.edit(edit);
  if (done) done = save(wanted, evaluator_->alarms().settings(), budget_.now);
  if (done) done = evaluator_->edit(edit);
  return note(origin, what, std::move(done));
}

Done SettingsEditor::change_budget(const Origin& origin, double up_kbit_s) {
  const std::string what = "radio budget up" + moved("kbit/s", budget_.now, up_kbit_s);
  if (const auto may = allowed(origin, "budget"); !may) return note(origin, what, may);
  if (!(up_kbit_s >= budget_.least && up_kbit_s <= budget_.most)) {
    return note(origin, what,
                Unexpected{Problem{"budget", "expected " + in_figures(budget_.least) + " to " +
                                                 in_figures(budget_.most) + " kbit/s"}});
  }
  auto done = save(evaluator_->limits(), evaluator_->alarms().settings(), up_kbit_s);
  if (done) budget_.now = up_kbit_s;
  return note(origin, what, std::move(done));
}

Done SettingsEditor::allowed(const Origin& origin, const std::string& place) const {
  if (!origin.holds_authority) {
    return Unexpected{Problem{place, "you do not hold the authority"}};
  }
  if (origin.reason.empty()) return Unexpected{Problem{place, "expected a reason for the change"}};
  return true;
}

Done SettingsEditor::save(const alarms::Limits& limits, const alarms::AlarmSettings& alarms,
                          double up_kbit_s) {
  if (save_) {
    auto saved = save_({.derive = evaluator_->params(),
                        .limits = limits,
                        .alarms = alarms,
                        .revision = revision_ + 1,
                        .up_kbit_s = up_kbit_s});
    if (!saved) return saved;
  }
  ++revision_;
  return true;
}

Done SettingsEditor::note(const Origin& origin, const std::string& what, Done result) {
  audit_->add(origin.at, origin.by.name,
              what + (origin.reason.empty() ? "" : " (" + origin.reason + ")"),
              result ? "revision " + std::to_string(revision_) : "refused: " + result.error().what);
  return result;
}

}  // namespace pitwall::command
