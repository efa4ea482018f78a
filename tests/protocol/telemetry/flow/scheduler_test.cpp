// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/scheduler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>
#include <type_traits>
#include <vector>

#include "tests/protocol/telemetry/flow/slot.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::telemetry {
namespace {

static_assert(std::is_trivially_copyable_v<Scheduler>);

constexpr Duration kRoundTrip = milliseconds(50);
constexpr Duration kAckWait = milliseconds(25);  // as the scheduler has it

Snapshot all_sampled(Instant at) {
  Snapshot snapshot;
  snapshot.sampled_at.fill(at);
  return snapshot;
}

bool is_safety(Group group) { return row_of(group).priority == Class::kSafety; }

std::size_t safety_groups(Direction direction) {
  return static_cast<std::size_t>(
      std::count_if(kGroupTable.begin(), kGroupTable.end(), [&](const GroupRow& row) {
        return row.direction == direction && row.priority == Class::kSafety;
      }));
}

TEST(Scheduler, SafetyComesFirstAndAlways) {
  for (const Direction direction : {Direction::kDown, Direction::kUp}) {
    Scheduler scheduler(direction);
    const std::size_t safety = safety_groups(direction);
    for (std::uint64_t i = 1; i < 200; ++i) {
      const Instant now = at_ms(static_cast<std::int64_t>(i) * 20);
      const Snapshot snapshot = all_sampled(now);
      const auto order = scheduler.order(snapshot, kRoundTrip, now);
      ASSERT_GE(order.size(), safety);
      GroupSet written;
      for (std::size_t k = 0; k < order.size(); ++k) {
        ASSERT_EQ(is_safety(order[k]), k < safety);
        ASSERT_EQ(row_of(order[k]).direction, direction);
        written.add(order[k]);
      }
      scheduler.sent(i, written, written, snapshot, now);
      scheduler.acked(i);
    }
  }
}

TEST(Scheduler, WhatWasNeverSampledIsNotOffered) {
  const Scheduler scheduler(Direction::kDown);
  EXPECT_TRUE(scheduler.order(Snapshot{}, kRoundTrip, at_ms(100), {.fill = true}).empty());
  Snapshot snapshot;
  snapshot.at(Group::kEgo) = at_ms(90);
  const auto order = scheduler.order(snapshot, kRoundTrip, at_ms(100), {.fill = true});
  ASSERT_EQ(order.size(), 1U);
  EXPECT_EQ(order[0], Group::kEgo);
}

TEST(Scheduler, WhatTheOtherEndHasIsNotOfferedAgain) {
  Scheduler scheduler(Direction::kDown);
  const Snapshot snapshot = all_sampled(at_ms(0));
  GroupSet all;
  for (const Group g : scheduler.order(snapshot, kRoundTrip, at_ms(0), {.fill = true})) all.add(g);
  scheduler.sent(1, all, all, snapshot, at_ms(0));
  // Under way: not due, but worth spare room.
  EXPECT_EQ(scheduler.order(snapshot, kRoundTrip, at_ms(20)).size(),
            safety_groups(Direction::kDown));
  EXPECT_GT(scheduler.order(snapshot, kRoundTrip, at_ms(20), {.fill = true}).size(),
            safety_groups(Direction::kDown));
  scheduler.acked(1);
  EXPECT_EQ(scheduler.order(snapshot, kRoundTrip, at_ms(10'000), {.fill = true}).size(),
            safety_groups(Direction::kDown));
}

// The order against the formula of the header, reckoned here from the history of sending.
TEST(Scheduler, OrdersByTheIndex) {
  std::mt19937_64 random(1);
  Scheduler scheduler(Direction::kDown);
  struct Sent {
    std::uint64_t sequence;
    Instant at;
    GroupSet written;
    Instant sampled;
    bool acked;
  };
  std::vector<Sent> history;
  for (std::uint64_t i = 1; i <= 400; ++i) {
    const Instant now = at_ms(static_cast<std::int64_t>(i) * 20);
    // Acknowledgements come in steadily, so nothing counts as lost before its round trip.
    for (Sent& s : history) {
      if (s.acked || now - s.at < milliseconds(40) || random() % 5 == 0) continue;
      s.acked = true;
      scheduler.acked(s.sequence);
    }
    const Snapshot snapshot = all_sampled(now - milliseconds(3));
    const auto index = [&](Group g) {
      double known_s = -3'600.0;
      for (const Sent& s : history) {
        if (s.written.has(g) && (s.acked || now - s.at < kRoundTrip + kAckWait)) {
          known_s = std::max(known_s, (s.sampled - now).seconds());
        }
      }
      const double t = row_of(g).target_age.seconds();
      const double late = std::max(0.0, -known_s - t / 2) / t;
      return row_of(g).weight * late * late / std::sqrt(static_cast<double>(group_bits(g)));
    };
    const auto order = scheduler.order(snapshot, kRoundTrip, now);
    GroupSet written;
    double last = INFINITY;
    for (const Group g : order) {
      if (is_safety(g)) continue;
      ASSERT_GT(index(g), 0.0);
      ASSERT_LE(index(g), last * (1 + 1e-9)) << i;
      last = index(g);
      if (random() % 3 == 0) written.add(g);
    }
    for (const GroupRow& row : kGroupTable) {
      const bool offered = std::find(order.begin(), order.end(), row.group) != order.end();
      if (row.direction != Direction::kDown || offered) continue;
      ASSERT_EQ(index(row.group), 0.0);
    }
    scheduler.sent(i, written, written, snapshot, now);
    history.push_back({i, now, written, now - milliseconds(3), false});
  }
}

// With a period: what has it, motion excepted, behind what is due and before all else, the oldest
// first.
TEST(Scheduler, SlowGroupsOfThePeriodComeBeforeTheRest) {
  Scheduler scheduler(Direction::kDown);
  const auto send = [&](std::uint64_t sequence, std::int64_t ms, GroupSet groups) {
    scheduler.sent(sequence, groups, groups, all_sampled(at_ms(ms)), at_ms(ms));
    scheduler.acked(sequence);
  };
  GroupSet fuel, tread;
  fuel.add(Group::kFuel);
  tread.add(Group::kTread);
  send(1, 0, groups_of(Direction::kDown));
  send(2, 20, tread);
  send(3, 40, fuel);
  const Snapshot snapshot = all_sampled(at_ms(70));
  const auto order =
      scheduler.order(snapshot, kRoundTrip, at_ms(70), {.period = milliseconds(50), .fill = true});
  const auto place = [&](Group group) {
    return std::find(order.begin(), order.end(), group) - order.begin();
  };
  ASSERT_EQ(order.size(), groups_of(Direction::kDown).count());
  EXPECT_LT(place(Group::kEgo), place(Group::kTyres));      // due by its target of 100 ms
  EXPECT_LT(place(Group::kPlanner), place(Group::kTyres));  // motion
  EXPECT_LT(place(Group::kTyres), place(Group::kTread));    // 70 ms old, 50 ms old
  EXPECT_LT(place(Group::kTread), place(Group::kFuel));     // 30 ms old: the rest
  EXPECT_EQ(place(Group::kFuel), static_cast<std::ptrdiff_t>(order.size()) - 1);
  const auto without = scheduler.order(snapshot, kRoundTrip, at_ms(70));
  EXPECT_EQ(std::find(without.begin(), without.end(), Group::kTyres), without.end());
}

// A link with a serial slot of a few bits and loss: who is served, and how old does it get?
class Link {
 public:
  Link(std::size_t room_bits, double loss, std::uint64_t seed)
      : room_bits_(room_bits), loss_(loss), random_(seed) {
    had_.fill(at_ms(0));
    oldest_.fill({});
  }

  void run(int slots) {
    for (int i = 0; i < slots; ++i) slot();
  }
  Duration oldest(Group g) const { return oldest_[index_of(g)]; }
  const Scheduler& scheduler() const { return scheduler_; }

 private:
  void slot() {
    now_ += kSlot;
    while (!acks_.empty() && acks_.front().at <= now_) {
      scheduler_.acked(acks_.front().sequence);
      acks_.pop_front();
    }
    const Snapshot snapshot = all_sampled(now_);
    GroupSet written, wanted;
    std::size_t room = room_bits_;
    for (const Group g : scheduler_.order(snapshot, kRoundTrip, now_)) {
      wanted.add(g);
      if (is_safety(g)) {
        written.add(g);
      } else if (group_bits(g) <= room) {
        room -= group_bits(g);
        written.add(g);
      }
    }
    scheduler_.sent(++sequence_, written, wanted, snapshot, now_);
    const bool lost = testing::draw_uniform(random_) < loss_;
    if (!lost) acks_.push_back({now_ + kRoundTrip, sequence_});
    for (const GroupRow& row : kGroupTable) {
      const std::size_t g = index_of(row.group);
      if (!lost && written.has(row.group)) had_[g] = now_;
      oldest_[g] = std::max(oldest_[g], now_ - had_[g]);
    }
  }

  struct Due {
    Instant at;
    std::uint64_t sequence;
  };
  Scheduler scheduler_{Direction::kDown};
  std::size_t room_bits_;
  double loss_;
  std::mt19937_64 random_;
  Instant now_ = at_ms(0);
  std::uint64_t sequence_ = (std::uint64_t{1} << 32) - 1'000;
  std::deque<Due> acks_;
  std::array<Instant, kGroups> had_;
  std::array<Duration, kGroups> oldest_;
};

std::size_t largest_group_bits() {
  std::size_t most = 0;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction == Direction::kDown) most = std::max(most, group_bits(row.group));
  }
  return most;
}

// Room for hardly more than the largest group alone, everything always newly sampled. A group that
// waits longer than this bound would have the highest index of all: the others were served once
// each in the meantime, so their ages are at most the time that all of them take, and the index
// falls with nothing else.
TEST(Scheduler, NoGroupStarves) {
  for (const double loss : {0.0, 0.3, 0.7}) {
    Link link(largest_group_bits(), loss, 3);
    link.run(50 * 600);
    for (const GroupRow& row : kGroupTable) {
      if (row.direction != Direction::kDown) continue;
      EXPECT_LT(link.oldest(row.group), seconds(20)) << row.name << ' ' << loss;
      EXPECT_GT(link.scheduler().figures(row.group).chosen, 100U) << row.name;
    }
    EXPECT_GT(link.scheduler().figures(Group::kTyres).skipped, 0U);
  }
}

TEST(Scheduler, AgesOfARoomyLinkKeepTheirTargets) {
  Link link(4'000, 0.0, 1);
  link.run(50 * 60);
  for (const GroupRow& row : kGroupTable) {
    if (row.direction != Direction::kDown) continue;
    EXPECT_LE(link.oldest(row.group), row.target_age) << row.name;
  }
}

// While nothing that was sent lately is acknowledged, each packet has what is oldest at the other
// end: the first that comes through after a fade refreshes it.
TEST(Scheduler, AfterAFadeTheFirstPacketHasWhatIsOldest) {
  Scheduler scheduler(Direction::kDown);
  std::uint64_t sequence = 0;
  const auto send = [&](Instant now) {
    const Snapshot snapshot = all_sampled(now);
    GroupSet written;
    for (const Group g : scheduler.order(snapshot, kRoundTrip, now)) written.add(g);
    scheduler.sent(++sequence, written, written, snapshot, now);
    return written;
  };
  for (int i = 0; i < 100; ++i) {
    send(at_ms(i * 20));
    if (i >= 3) scheduler.acked(sequence - 3);
  }
  for (int i = 100; i < 120; ++i) {  // the fade: no acknowledgement
    const GroupSet written = send(at_ms(i * 20));
    if (i < 106) continue;
    for (const GroupRow& row : kGroupTable) {
      if (row.direction != Direction::kDown || row.target_age > milliseconds(200)) continue;
      EXPECT_TRUE(written.has(row.group)) << row.name << ' ' << i;
    }
  }
}

TEST(Scheduler, TakesNothingFromTheHeap) {
  if (!testing::kAllocationsCounted) GTEST_SKIP() << "AddressSanitizer has a heap of its own";
  Scheduler scheduler(Direction::kDown);
  const auto work = [&] {
    for (std::uint64_t i = 1; i < 100; ++i) {
      const Snapshot snapshot = all_sampled(at_ms(static_cast<std::int64_t>(i) * 20));
      GroupSet written;
      for (const Group g :
           scheduler.order(snapshot, kRoundTrip, snapshot.at(Group::kEgo), {.fill = true})) {
        written.add(g);
      }
      scheduler.sent(i, written, written, snapshot, snapshot.at(Group::kEgo));
      scheduler.acked(i);
    }
  };
  EXPECT_EQ(testing::allocations_of(work), 0U);
}

TEST(Scheduler, ANewSessionKnowsNothing) {
  Scheduler scheduler(Direction::kDown);
  const Snapshot snapshot = all_sampled(at_ms(0));
  GroupSet all;
  const auto order = scheduler.order(snapshot, kRoundTrip, at_ms(0));
  for (const Group g : order) all.add(g);
  scheduler.sent(7, all, all, snapshot, at_ms(0));
  scheduler.acked(7);
  scheduler.acked(8);  // never sent: nothing
  scheduler.forget();
  EXPECT_EQ(scheduler.order(snapshot, kRoundTrip, at_ms(1)).size(), order.size());
  scheduler.sent(1, all, all, snapshot, at_ms(2));
  EXPECT_EQ(scheduler.figures(Group::kEgo).chosen, 2U);
  EXPECT_EQ(scheduler.figures(Group::kEgo).acked_sample, kNeverSampled);
}

}  // namespace
}  // namespace pitwall::telemetry
