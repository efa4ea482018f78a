// Settings and operator entries, as the texts `settings` and `expected` of PROTOCOL.md.
//   in     the settings editor, the alarms in force; what people said
//   out    one JSON object each
//   units  seconds for delays, else as the field of the alarm has them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "basestation/alarms/alarm_table.hpp"
#include "basestation/command/request_executor.hpp"
#include "basestation/command/settings_editor.hpp"

namespace pitwall::service {

// `unreadable`: the file that should have been read, as long as it is the old one.
std::string settings_text(const command::SettingsEditor& editor,
                          const alarms::AlarmSettings& alarms,
                          const std::optional<Problem>& unreadable = {});
// `fuel_left_l`: of what was filled in, as it is reckoned now.
std::string expected_text(const command::OperatorEntries& entries, double fuel_left_l, Instant now);

// "settings file unreadable: FILE:3:5: ...; built-in limits in force"
std::string unreadable_text(const Problem& problem);

}  // namespace pitwall::service
