// Requests of operators: all that a console, the command socket or a script can ask of one car's
// service. Who sends one is a Person beside it.
//   invariants  whoever parses the text has checked the ranges and resolved the names
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "basestation/alarms/alarm_table.hpp"
#include "basestation/alarms/engine.hpp"
#include "basestation/alarms/limits.hpp"
#include "basestation/command/command_queue.hpp"
#include "basestation/command/stop_episode.hpp"
#include "protocol/telemetry/command/stop_latch.hpp"

namespace pitwall::command {

// Needs no authority and passes no gate.
struct Stop {
  telemetry::StopLevel level = telemetry::StopLevel::kControlled;
};
struct ReleaseStop {
  std::optional<Override> overriding{};
};

// A step back to driving after a stop.
struct Recover {
  RecoveryStep step = RecoveryStep::kRelease;
  // Of a release: the latch that who asks has seen; none: whichever there is.
  std::optional<double> challenge{};
};

enum class Claim : std::uint8_t { kTake, kRenew, kDrop, kRequest, kGrant, kRefuse };
struct ClaimAuthority {
  Claim claim = Claim::kTake;
};

struct StageCommand {
  telemetry::CommandType type = telemetry::CommandType::kArm;
  double argument = 0.0;
};
struct SendTicket {
  TicketId ticket = 0;
  std::optional<Override> overriding{};
};
struct CancelTicket {
  TicketId ticket = 0;
};
// Staged and sent at once.
struct IssueCommand {
  telemetry::CommandType type = telemetry::CommandType::kArm;
  double argument = 0.0;
  std::optional<Override> overriding{};
};
// Added to or taken from the set that was ordered last or that the car reports.
struct ExcludeSensor {
  std::uint32_t bit = 0;  // of CommandType::kSensorsExcluded
  bool exclude = true;
};

struct AcknowledgeAlarms {
  std::vector<alarms::AlarmId> alarms{};
  std::string key{};  // or the alarm of this key
  bool all = false;   // or whatever is active and not acknowledged
};
struct ShelveAlarm {
  alarms::AlarmId alarm = 0;
  Duration length{};
  std::string reason{};
};
struct UnshelveAlarm {
  alarms::AlarmId alarm = 0;
};
struct ResetAlarm {
  alarms::AlarmId alarm = 0;
  std::string key{};  // where it is given: the alarm of this key
};
struct AnswerNotice {
  std::uint32_t notice = 0;
  bool reported = false;  // race control was told; else it need not be
};

// The round speed that race control announced; none: it was taken back.
struct ExpectRoundSpeed {
  std::optional<double> speed_mps{};
};
struct ReportFuel {
  double litres = 0.0;  // in the tank now
};
struct EditAlarm {
  alarms::AlarmEdit edit{};  // without author and reason
  std::string reason{};
};
struct EditLimit {
  alarms::LimitEdit edit{};                                     // bounds only
  std::optional<std::uint64_t> warning_values{}, bad_values{};  // none: as they are
  std::string reason{};
};
struct EditBudget {
  double up_kbit_s = 0.0;
  std::string reason{};
};

using Request = std::variant<Stop, ReleaseStop, Recover, ClaimAuthority, StageCommand, SendTicket,
                             CancelTicket, IssueCommand, ExcludeSensor, AcknowledgeAlarms,
                             ShelveAlarm, UnshelveAlarm, ResetAlarm, AnswerNotice, ExpectRoundSpeed,
                             ReportFuel, EditAlarm, EditLimit, EditBudget>;

}  // namespace pitwall::command
