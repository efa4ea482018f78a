// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/scheduler.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

// Both ends send once in 20 ms. So long a packet waits for its acknowledgement to be written; and
// with what the sender waits for its own next slot, after so long it should have been.
constexpr Duration kAckWait = milliseconds(25), kAckSilence = milliseconds(45);
constexpr Duration kUnknownAge = seconds(3'600);  // of what the other end never had

enum class Rank : std::uint8_t { kDue, kMotion, kPeriod, kFill };
struct Candidate {
  Group group;
  Rank rank;
  double value;  // the highest first

  bool operator<(const Candidate& other) const {
    if (rank != other.rank) return rank < other.rank;
    return value != other.value ? value > other.value : group < other.group;
  }
};

double index_at(const GroupRow& row, Duration age) {
  const double target_s = row.target_age.seconds();
  const double late = std::max(0.0, age.seconds() - target_s / 2) / target_s;
  return row.weight * late * late / std::sqrt(static_cast<double>(group_bits(row.group)));
}

}  // namespace

Scheduler::Scheduler(Direction direction) : direction_(direction) { forget(); }

void Scheduler::forget() {
  for (GroupFigures& f : figures_) f.acked_sample = kNeverSampled;
  packets_.fill({});
  last_sample_.fill(kNeverSampled);
  last_sent_.fill(kNeverSampled);
  newest_acked_ = newest_ = 0;
}

bool Scheduler::silent(Duration round_trip, Instant now) const {
  return newest_ > newest_acked_ && now > oldest_doubtful_ + round_trip + kAckSilence;
}

Instant Scheduler::known_sample(Group group, Duration round_trip, Instant now) const {
  const std::size_t g = index_of(group);
  const Instant acked = figures_[g].acked_sample;
  const bool under_way = last_sent_[g] != kNeverSampled &&
                         now < last_sent_[g] + round_trip + kAckWait && !silent(round_trip, now);
  return under_way ? std::max(acked, last_sample_[g]) : acked;
}

Scheduler::Order Scheduler::order(const Snapshot& snapshot, Duration round_trip, Instant now,
                                  Early early) const {
  Order order;
  FixedVector<Candidate, kGroups> candidates;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction != direction_ || !snapshot.ever(row.group)) continue;
    if (row.priority == Class::kSafety) {
      CHECK(order.push(row.group));
      continue;
    }
    const Instant known = known_sample(row.group, round_trip, now);
    const Duration age = known == kNeverSampled ? kUnknownAge : now - known;
    const bool is_motion = row.priority == Class::kMotion;
    const bool newer = snapshot.at(row.group) > known;
    const bool doubtful = snapshot.at(row.group) > figures(row.group).acked_sample;
    if (const double index = index_at(row, age); newer && index > 0.0) {
      CHECK(candidates.push({row.group, Rank::kDue, index}));
    } else if (newer && !is_motion && age >= early.period) {
      CHECK(candidates.push({row.group, Rank::kPeriod, age.seconds()}));
    } else if (early.fill && doubtful) {
      const double nearness = age.seconds() / row.target_age.seconds();
      CHECK(candidates.push({row.group, is_motion ? Rank::kMotion : Rank::kFill, nearness}));
    }
  }
  std::sort(candidates.begin(), candidates.end());
  for (const Candidate& c : candidates) CHECK(order.push(c.group));
  return order;
}

void Scheduler::sent(std::uint64_t sequence, GroupSet written, GroupSet wanted,
                     const Snapshot& snapshot, Instant now) {
  CHECK(sequence > newest_);
  if (newest_ == newest_acked_) oldest_doubtful_ = now;
  newest_ = sequence;
  packets_[sequence % kKept] = {sequence, written, now, snapshot.sampled_at};
  for (const GroupRow& row : kGroupTable) {
    const std::size_t g = index_of(row.group);
    if (written.has(row.group)) {
      ++figures_[g].chosen;
      last_sample_[g] = snapshot.at(row.group);
      last_sent_[g] = now;
    } else if (wanted.has(row.group)) {
      ++figures_[g].skipped;
    }
  }
}

void Scheduler::acked(std::uint64_t sequence) {
  const Packet& packet = packets_[sequence % kKept];
  if (sequence == 0 || packet.sequence != sequence) return;
  for (const GroupRow& row : kGroupTable) {
    const std::size_t g = index_of(row.group);
    if (!packet.written.has(row.group)) continue;
    figures_[g].acked_sample = std::max(figures_[g].acked_sample, packet.sampled_at[g]);
  }
  if (sequence <= newest_acked_) return;
  newest_acked_ = sequence;
  const Packet& next = packets_[(sequence + 1) % kKept];
  oldest_doubtful_ = next.sequence == sequence + 1 ? next.sent : packet.sent;
}

}  // namespace pitwall::telemetry
