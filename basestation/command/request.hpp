// Operator requests: all that a console, the command socket or a script can request of one car's
// service. The sender is given beside it, as a Person.
//   invariants  the parser of the text has checked the ranges and resolved the names
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

// Needs no authority and no gate.
struct Stop {
  telemetry::StopLevel level = telemetry::StopLevel::kControlled;
};
struct ReleaseStop {
  std::optional<Override> overriding{};
};

// One step of the recovery from a stop.
struct Recover {
  RecoveryStep step = RecoveryStep::kRelease;
  // Of a release: the challenge of the latch that the operator saw; nullopt: of the present latch.
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
// Stages and sends at once.
struct IssueCommand {
  telemetry::CommandType type = telemetry::CommandType::kArm;
  double argument = 0.0;
  std::optional<Override> overriding{};
};
// Changes the set that was ordered last, or else the set that the car reports.
struct ExcludeSensor {
  std::uint32_t bit = 0;  // of CommandType::kSensorsExcluded
  bool exclude = true;
};

struct AcknowledgeAlarms {
  std::vector<alarms::AlarmId> alarms{};
  std::string key{};  // or the alarm with this key
  bool all = false;   // or every active alarm that is not acknowledged
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
  std::string key{};  // if not empty: the alarm with this key
};
struct AnswerNotice {
  std::uint32_t notice = 0;
  bool reported = false;  // to race control; false: not needed
};

// The round speed that race control announced; nullopt: race control has withdrawn it.
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
  std::optional<std::uint64_t> warning_values{}, bad_values{};  // nullopt: unchanged
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
