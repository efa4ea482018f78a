// Settings and operator entries, as the texts `settings` and `expected` of PROTOCOL.md.
//   in     the settings editor, the alarms in force; entries of operators
//   out    one JSON object each
//   units  seconds for delays, otherwise the unit of the alarm's field
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "basestation/alarms/alarm_table.hpp"
#include "basestation/command/request_executor.hpp"
#include "basestation/command/settings_editor.hpp"

namespace pitwall::service {

// `unreadable`: the error of the settings file, as long as the file is not replaced.
std::string settings_text(const command::SettingsEditor& editor,
                          const alarms::AlarmSettings& alarms,
                          const std::optional<Problem>& unreadable = {});
// `fuel_left_l`: the present estimate of the fuel that was entered.
std::string expected_text(const command::OperatorEntries& entries, double fuel_left_l, Instant now);

// "settings file unreadable: FILE:3:5: ...; built-in limits in force"
std::string unreadable_text(const Problem& problem);

}  // namespace pitwall::service
