// What a console asks for, read from its text: see PROTOCOL.md.
//   in     one JSON text of a client
//   out    the request with every number in its range; the role that it takes
//   errors Problem with the member as place; nothing is guessed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "basestation/outlets/bench/bench_link.hpp"
#include "basestation/outlets/web/client.hpp"
#include "basestation/picture/alarms/alarm_table.hpp"
#include "basestation/picture/limits.hpp"
#include "protocol/telemetry/command/stop_latch.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::outlets::wall {

using web::ClientId;
using web::Role;

inline constexpr std::size_t kPointsMax = 20'000;

struct AskHistory {
  std::uint16_t field = 0;
  double from_s = 0.0, to_s = 0.0;  // before now; from is further back
  std::size_t points = kPointsMax;
};
struct AskAcknowledge {
  std::vector<std::uint32_t> alarms;
};
struct AskShelve {
  std::uint32_t alarm = 0;
  double minutes = 0.0;
  std::string reason;
};
struct AskUnshelve {
  std::uint32_t alarm = 0;
};
struct AskReset {
  std::uint32_t alarm = 0;
};
struct AskStop {
  telemetry::StopLevel level = telemetry::StopLevel::kControlled;
};
struct AskReleaseStop {};
enum class Claim : std::uint8_t { kTake, kRenew, kDrop, kRequest, kGrant, kRefuse };
struct AskAuthority {
  Claim claim = Claim::kTake;
  ClientId to = 0;
};
struct AskStage {
  std::string name;
  double argument = 0.0;
};
struct AskSend {
  std::uint32_t ticket = 0;
  bool overrides = false;
  std::string reason, token;  // of an override
};
struct AskCancel {
  std::uint32_t ticket = 0;
};
struct AskMark {
  std::string text;
};
struct AskNotice {
  std::uint32_t id = 0;
  bool send = false;  // else it is dismissed
};
struct AskPing {
  double at = 0.0;
};
// The round speed that race control announced; none: it was taken back.
struct AskExpect {
  std::optional<double> round_speed_mps;
};
struct AskFuelLoaded {
  double litres = 0.0;  // in the tank now
};
struct AskEditAlarm {
  alarms::AlarmEdit edit;  // without author and reason
  std::string reason;
};
struct AskEditLimit {
  picture::LimitEdit edit;                                  // bounds only
  std::optional<std::uint64_t> warning_values, bad_values;  // none: as they are
  std::string reason;
};
struct AskEditBudget {
  double up_kbit_s = 0.0;
  std::string reason;
};
struct AskBench {
  bench::BenchWish wish;
};
// Of a replay only.
struct AskPlayback {
  std::optional<double> speed;  // recorded seconds per second; 0: pause; backwards below
  std::optional<double> to_ms;  // on the clock of time_ns
};

using Request = std::variant<AskHistory, AskPing, AskMark, AskAcknowledge, AskShelve, AskUnshelve,
                             AskReset, AskStop, AskReleaseStop, AskAuthority, AskStage, AskSend,
                             AskCancel, AskNotice, AskPlayback, AskExpect, AskFuelLoaded,
                             AskEditAlarm, AskEditLimit, AskEditBudget, AskBench>;

Result<Request, Problem> parse_request(std::string_view text);
Role role_for(const Request& request);

}  // namespace pitwall::outlets::wall
