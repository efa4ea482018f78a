// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/state_lane.hpp"

#include <algorithm>

#include "protocol/telemetry/registry/schema.hpp"

namespace pitwall::telemetry {
namespace {

std::size_t size_of(GroupSet groups, Direction direction) {
  return groups.empty() ? 0 : state_bytes(groups, direction);
}

}  // namespace

StateLane::StateLane(Direction direction)
    : direction_(direction), scheduler_(direction), known_(groups_of(direction)) {}

std::size_t StateLane::safety_size(const Snapshot& snapshot) const {
  GroupSet safety;
  for (const GroupRow& row : kGroupTable) {
    const bool ours = row.direction == direction_ && row.priority == Class::kSafety;
    if (ours && snapshot.ever(row.group) && known_.has(row.group)) safety.add(row.group);
  }
  return size_of(safety, direction_);
}

std::size_t StateLane::write(BodyWriter& body, const Snapshot& snapshot, const Writing& how,
                             Instant now) {
  wanted_ = {};
  GroupSet late;
  for (const Group group : scheduler_.order(snapshot, how.round_trip, now)) late.add(group);
  Scheduler::Order order;
  for (const Group group : scheduler_.order(snapshot, how.round_trip, now, how.fill)) {
    const Class priority = row_of(group).priority;
    if (!known_.has(group) || (how.only_safety && priority != Class::kSafety)) continue;
    if (priority > Class::kMotion && !late.has(group)) continue;
    wanted_.add(group);
    CHECK(order.push(group));
  }
  const std::size_t before = body.bytes().size();
  written_ = body.add_groups(snapshot, order.span(), now, codec_);
  GroupSet safety;
  for (const GroupRow& row : kGroupTable) {
    if (written_.has(row.group) && row.priority == Class::kSafety) safety.add(row.group);
  }
  return std::min(body.bytes().size() - before, size_of(safety, direction_));
}

void StateLane::sent(std::uint64_t sequence, const Snapshot& snapshot, Instant now) {
  scheduler_.sent(sequence, written_, wanted_, snapshot, now);
}

void StateLane::forget(GroupSet known) {
  scheduler_.forget();
  known_ = known;
}

}  // namespace pitwall::telemetry
