// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/scheduler.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

// Both ends send once in 20 ms. So long a packet waits for its acknowledgement to be written; and
// with what the sender waits for its own next slot, after so long it should have been.
constexpr Duration kAckWait = milliseconds(25), kSilence = milliseconds(45);
constexpr Duration kUnknownAge = seconds(3'600);  // of what the other end never had

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
  return newest_ > newest_acked_ && now > oldest_doubtful_ + round_trip + kSilence;
}

Instant Scheduler::known_sample(Group group, Duration round_trip, Instant now) const {
  const std::size_t g = index_of(group);
  const Instant acked = figures_[g].acked_sample;
  const bool under_way = last_sent_[g] != kNeverSampled &&
                         now < last_sent_[g] + round_trip + kAckWait && !silent(round_trip, now);
  return under_way ? std::max(acked, last_sample_[g]) : acked;
}

double Scheduler::index(Group group, const Snapshot& snapshot, Duration round_trip,
                        Instant now) const {
  const Instant known = known_sample(group, round_trip, now);
  if (snapshot.at(group) <= known) return 0.0;
  const GroupRow& row = row_of(group);
  const double target_s = row.target_age.seconds();
  const double age_s = (known == kNeverSampled ? kUnknownAge : now - known).seconds();
  const double late = std::max(0.0, age_s - target_s / 2) / target_s;
  return row.weight * late * late / std::sqrt(static_cast<double>(group_bits(group)));
}

Scheduler::Order Scheduler::order(const Snapshot& snapshot, Duration round_trip, Instant now,
                                  bool fill) const {
  struct Candidate {
    Group group;
    double value;
  };
  Order order;
  FixedVector<Candidate, kGroups> due;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction != direction_ || !snapshot.ever(row.group)) continue;
    if (row.priority == Class::kSafety) {
      CHECK(order.push(row.group));
      continue;
    }
    double value = index(row.group, snapshot, round_trip, now);
    if (value <= 0.0) {
      if (!fill || snapshot.at(row.group) <= figures(row.group).acked_sample) continue;
      // Below all that are due: the nearer to being due, the sooner.
      const Instant known = known_sample(row.group, round_trip, now);
      const Duration age = known == kNeverSampled ? kUnknownAge : now - known;
      value = -1.0 / (1.0 + age.seconds() / row.target_age.seconds());
    }
    CHECK(due.push({row.group, value}));
  }
  std::sort(due.begin(), due.end(), [](const Candidate& a, const Candidate& b) {
    return a.value != b.value ? a.value > b.value : a.group < b.group;
  });
  for (const Candidate& c : due) CHECK(order.push(c.group));
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
