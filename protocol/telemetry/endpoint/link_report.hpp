// Status report of one end of the radio link at one moment, for views, logs and tests.
//   units  in the names or by the type; shares 0 .. 1
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/command/command_ledger.hpp"
#include "protocol/telemetry/delivery/bulk.hpp"
#include "protocol/telemetry/delivery/events.hpp"
#include "protocol/telemetry/flow/link_stats.hpp"
#include "protocol/telemetry/flow/path_budget.hpp"
#include "protocol/telemetry/flow/scheduler.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/session/association.hpp"
#include "protocol/telemetry/session/link_threats.hpp"

namespace pitwall::telemetry {

struct PathReport {
  PathFigures received;     // traffic that arrives at this end
  BudgetCounters spent;     // traffic that leaves it
  double budget_use = 0.0;  // traffic sent in the last second, 0 .. 1 of the whole rate
  double rate_factor = 1.0;
  Duration queue_delay{};
  UdpAddress peer;
  bool validated = false;
};

struct LinkReport {
  bool established = false;
  std::uint64_t sessions = 0;
  std::array<PathReport, kPaths> paths{};
  AssociationCounters association;
  ThreatSet threats;  // active at this end
  std::array<std::uint64_t, kBodyErrors> bad_bodies{};
  std::uint64_t bad_records = 0;
  std::uint64_t slots = 0, slots_skipped = 0;
  CodecCounters codec;
  std::optional<Duration> round_trip, clock_offset, clock_bound;
  double both_lost = 0.0;
  std::array<GroupFigures, kGroups> groups{};
  LedgerCounters ledger;  // car only
  EventCounters events;
  BulkCounters bulk;
  std::uint64_t ack_nonsense = 0;
};

}  // namespace pitwall::telemetry
