// Scheduler of the groups for the next packet: safety groups always, then by the age of the newest
// sample that the other end is known to have.
//   invariants  index_g = w_g * (max(0, age_g - T_g / 2) / T_g)^2 / sqrt(bits_g). age_g counts from
//          the sample that was acknowledged, or that is under way for less than a round trip and
//          the wait for the acknowledgement to be written. Ages grow without bound, so no group
//          starves. A sample that the other end has is not offered again
//          after the groups with an index above zero come the slow groups that are as old as the
//          period that the caller gives, the oldest first
//          while packets stay without acknowledgement for too long, those under way count as lost:
//          so the first packet that arrives after a fade has the oldest groups
//   in     snapshots, the groups written into each packet, the acknowledged packets
//   out    groups in falling order of priority; counters that explain each choice
//   cost   O(G log G), no allocation
//   source Kadota et al., "Scheduling Policies for Minimizing Age of Information in Broadcast
//          Wireless Networks", 2018, max-weight policy
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct GroupFigures {
  std::uint64_t chosen = 0,
                skipped = 0;  // packets that had it; packets without room for it though it was due
  Instant acked_sample = kNeverSampled;  // newest sample that the other end is known to have
};

class Scheduler {
 public:
  explicit Scheduler(Direction direction);

  using Order = FixedVector<Group, kGroups>;
  static constexpr Duration kNoPeriod{INT64_MAX};
  // Offer of groups with index zero.
  struct Early {
    Duration period = kNoPeriod;  // age from which slow groups are offered
    // Offers all others too: motion before the groups of `period`, the rest after them; in each
    // part the group nearest to its target age first.
    bool fill = false;
  };
  // Sampled groups: those of class kSafety first, then by falling index, then the early ones.
  Order order(const Snapshot& snapshot, Duration round_trip, Instant now, Early early) const;
  Order order(const Snapshot& snapshot, Duration round_trip, Instant now) const {
    return order(snapshot, round_trip, now, Early{});
  }

  void sent(std::uint64_t sequence, GroupSet written, GroupSet wanted, const Snapshot& snapshot,
            Instant now);
  void acked(std::uint64_t sequence);
  void forget();  // new session: no sample counts as received by the other end
  // True if packets that should be acknowledged by now are not.
  bool silent(Duration round_trip, Instant now) const;

  const GroupFigures& figures(Group group) const { return figures_[index_of(group)]; }

 private:
  static constexpr std::size_t kKept = 256;

  struct Packet {
    std::uint64_t sequence = 0;  // 0: none
    GroupSet written;
    Instant sent{};
    std::array<Instant, kGroups> sampled_at{};
  };

  Instant known_sample(Group group, Duration round_trip, Instant now) const;

  Direction direction_;
  std::array<GroupFigures, kGroups> figures_{};
  std::array<Packet, kKept> packets_{};
  std::array<Instant, kGroups> last_sample_{}, last_sent_{};  // newest sent, by group
  // Time of sending of the first packet after the newest acknowledged one.
  Instant oldest_doubtful_ = kNeverSampled;
  std::uint64_t newest_acked_ = 0, newest_ = 0;
};

}  // namespace pitwall::telemetry
