// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/state_lane.hpp"

#include <algorithm>

#include "protocol/telemetry/endpoint/slots.hpp"

namespace pitwall::telemetry {
namespace {

constexpr double kStateShare = 0.5;  // of the present rate, before bulk
// Of a packet, whatever is in it.
constexpr std::size_t kPacketOverhead =
    kIpUdpOverhead + kHeaderSize + kTagSize + kBodyFixed + kAckSize;

bool is_slow(Group group) { return row_of(group).priority > Class::kMotion; }

std::size_t size_of(GroupSet groups, Direction direction) {
  return groups.empty() ? 0 : state_bytes(groups, direction);
}

std::size_t fast_size(Direction direction) {
  GroupSet fast;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction == direction && row.priority <= Class::kMotion) fast.add(row.group);
  }
  return size_of(fast, direction);
}

}  // namespace

StateLane::StateLane(Direction direction, double early_share)
    : direction_(direction),
      early_share_(early_share),
      fast_size_(fast_size(direction)),
      scheduler_(direction) {
  CHECK(early_share >= 0.0 && early_share <= 1.0);
}

// Motion goes before its time once in a slot, where that leaves a third of the packet to what
// waits; between slots only where nothing waits. There a packet has safety and motion alone, so
// that the next one of a slot has room for all groups.
bool StateLane::takes(Group group, Writing how, std::size_t room) const {
  const Class priority = row_of(group).priority;
  if (priority == Class::kSafety) return true;
  if (how.only_safety) return false;
  const bool motion = priority == Class::kMotion;
  const bool spare = !how.something_waits || (!how.between && 3 * fast_size_ <= 2 * room);
  if (!late_.has(group)) return motion && spare;
  return motion || !how.between || how.something_waits;
}

Duration StateLane::refresh_period(GroupSet groups, double bytes_per_s) const {
  GroupSet fast, slow;
  for (const GroupRow& row : kGroupTable) {
    if (groups.has(row.group)) (is_slow(row.group) ? slow : fast).add(row.group);
  }
  const double bits = static_cast<double>(kAgeCodeBits * slow.count() + bits_of(slow));
  const auto each_slot = static_cast<double>(kPacketOverhead + size_of(fast, direction_));
  const double left = kStateShare * bytes_per_s - each_slot / kSlot.seconds();
  return left >= 1.0 ? from_seconds(bits / 8.0 / left) : Scheduler::kNoPeriod;
}

std::size_t StateLane::choose(const Snapshot& snapshot, GroupSet known, Path path, Instant now) {
  GroupSet sampled;
  for (const GroupRow& row : kGroupTable) {
    if (known.has(row.group) && snapshot.ever(row.group)) sampled.add(row.group);
  }
  const Duration period = refresh_period(sampled, path.bytes_per_s);
  const auto order = [&](bool fill) {
    return scheduler_.order(snapshot, path.round_trip, now, {.period = period, .fill = fill});
  };
  late_ = {};
  for (const Group group : order(false)) late_.add(group);
  order_.clear();
  GroupSet safety;
  for (const Group group : order(true)) {
    if (!known.has(group)) continue;
    CHECK(order_.push(group));
    if (row_of(group).priority == Class::kSafety) safety.add(group);
  }
  return size_of(safety, direction_);
}

// Where nothing waits and the packet is far from full, slow groups go before their time, too, the
// nearer to it the sooner.
void StateLane::add_early(Scheduler::Order& wanted, Writing how, std::size_t room) const {
  if (how.only_safety || how.between || how.something_waits || 3 * fast_size_ > 2 * room) return;
  auto bits = static_cast<std::size_t>(static_cast<double>(8 * room) * early_share_);
  for (const Group group : order_) {
    const std::size_t size = kAgeCodeBits + group_bits(group);
    if (late_.has(group) || !is_slow(group) || size > bits) continue;
    bits -= size;
    CHECK(wanted.push(group));
  }
}

std::size_t StateLane::write(BodyWriter& body, const Snapshot& snapshot, Writing how, Instant now) {
  wanted_ = {};
  Scheduler::Order wanted;
  for (const Group group : order_) {
    if (!takes(group, how, body.room_left())) continue;
    wanted_.add(group);
    CHECK(wanted.push(group));
  }
  add_early(wanted, how, body.room_left());
  const std::size_t before = body.bytes().size();
  written_ = body.add_groups(snapshot, wanted.span(), now, codec_);
  GroupSet safety;
  for (const GroupRow& row : kGroupTable) {
    if (written_.has(row.group) && row.priority == Class::kSafety) safety.add(row.group);
  }
  return std::min(body.bytes().size() - before, size_of(safety, direction_));
}

void StateLane::sent(std::uint64_t sequence, const Snapshot& snapshot, Instant now) {
  scheduler_.sent(sequence, written_, wanted_, snapshot, now);
}

void StateLane::report(LinkReport& out) const {
  out.codec = codec_;
  for (const GroupRow& row : kGroupTable) {
    out.groups[index_of(row.group)] = scheduler_.figures(row.group);
  }
}

}  // namespace pitwall::telemetry
