// All figures of one end of the radio at one moment: what views, logs and tests show.
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
  PathFigures received;     // of what comes to this end
  BudgetCounters spent;     // of what leaves it
  double budget_use = 0.0;  // of the last second, 0 .. 1 of the whole rate
  double rate_factor = 1.0;
  Duration queue_delay{};
  Address peer;
  bool validated = false;
};

struct LinkReport {
  bool established = false;
  std::uint64_t sessions = 0;
  std::array<PathReport, kPaths> paths{};
  AssociationCounters association;
  ThreatSet threats;  // that this end sees
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
