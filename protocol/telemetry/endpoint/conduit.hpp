// What car and base have in common on the radio: association, budgets, acknowledgements, clock,
// figures. Knows nothing of what packets mean.
//   in     datagrams of each path; bodies to send
//   out    opened bodies, each once; datagrams for each path, within its budget
//   law    one slot each kSlot; a slot for which the budget has no room is skipped, never queued
//   errors counted by Association, BodyError and the modules below
//   cost   no allocation after construction
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/flow/acks.hpp"
#include "protocol/telemetry/flow/clock_sync.hpp"
#include "protocol/telemetry/flow/link_stats.hpp"
#include "protocol/telemetry/flow/path_budget.hpp"
#include "protocol/telemetry/flow/rate_control.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/packet/received.hpp"
#include "protocol/telemetry/session/association.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kSlot = milliseconds(20);

// Which class of content goes on which of two paths.
enum class PathPolicy : std::uint8_t {
  kDuplicate,  // everything on all paths that have room
  kBest        // safety on all, the rest on the better one
};

struct ConduitConfig {
  AssociationConfig association;
  std::array<BudgetParams, kPaths> budget{};
  PathPolicy policy = PathPolicy::kDuplicate;
};

struct Outgoing {
  PathId path = 0;
  Address to;
  std::span<const std::uint8_t> bytes;  // until the next call
};

}  // namespace pitwall::telemetry
