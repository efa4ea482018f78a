// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/clock_sync.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <type_traits>
#include <vector>

#include "tests/support/draw.hpp"

namespace pitwall::telemetry {
namespace {

static_assert(std::is_trivially_copyable_v<ClockSync>);

struct Scene {
  Duration up = milliseconds(15), down = milliseconds(15), jitter{};
  double drift_ppm = 0.0, loss = 0.0;
  Duration theirs_at_start = seconds(1'000);
};

// Two ends that send each 20 ms; the other end answers with the hold of what it had last. The
// world's time is ours, the other end's clock drifts against it.
class Pair {
 public:
  Pair(const Scene& scene, std::uint64_t seed) : scene_(scene), random_(seed) {}

  Instant theirs(Instant ours) const {
    const double ns = static_cast<double>(ours.ns) * scene_.drift_ppm * 1e-6;
    return ours + scene_.theirs_at_start + nanoseconds(std::llround(ns));
  }
  Duration true_offset(Instant now) const { return theirs(now) - now; }

  // One slot of 20 ms; returns the one-way delay error of the packet that came, if one did.
  std::optional<Duration> slot() {
    now_ += milliseconds(20);
    if (came()) on_the_way_.push_back({now_, now_ + delay(scene_.up)});
    const Instant sends = now_ + milliseconds(11);
    // In order of sending; one that was overtaken is not the newest any more.
    for (std::size_t i = 0; i < on_the_way_.size(); ++i) {
      if (on_the_way_[i].arrives > sends) continue;
      there_ = on_the_way_[i];
      on_the_way_.erase(on_the_way_.begin(), on_the_way_.begin() + static_cast<long>(i) + 1);
      i = static_cast<std::size_t>(-1);
    }
    if (!came()) return std::nullopt;
    const Duration way = delay(scene_.down);
    const Instant received = sends + way;
    const Instant t3 = sync.peer_time(wrap_tx_time(theirs(sends)), received);
    if (there_) {
      const Duration hold{(theirs(sends) - theirs(there_->arrives)).ns / 100'000 * 100'000};
      sync.note({there_->sent, t3 - hold, t3, received});
    }
    last_ = received;
    if (!sync.known()) return std::nullopt;
    return sync.one_way(t3, received) - way;
  }

  // Theirs as we count it may differ from theirs by whole wraps of tx_time.
  Duration error(Instant now) const {
    const std::int64_t wrap = (std::int64_t{1} << 24) * 100'000;
    const std::int64_t raw = (sync.offset() - true_offset(now)).ns;
    return {raw - wrap * std::llround(static_cast<double>(raw) / static_cast<double>(wrap))};
  }
  Instant now() const { return std::max(now_, last_); }

  ClockSync sync;

 private:
  bool came() { return testing::draw_uniform(random_) >= scene_.loss; }
  Duration delay(Duration least) {
    const auto span = static_cast<double>(scene_.jitter.ns);
    return least + nanoseconds(std::llround(testing::draw_uniform(random_, 0.0, span)));
  }

  Scene scene_;
  std::mt19937_64 random_;
  struct Packet {
    Instant sent{}, arrives{};
  };
  Instant now_{}, last_{};
  std::vector<Packet> on_the_way_;
  std::optional<Packet> there_;  // the newest that came
};

Duration size(Duration d) { return d < Duration{} ? -d : d; }

TEST(ClockSync, TheBoundAlwaysHoldsAndTheErrorIsTheAsymmetry) {
  for (const double drift_ppm : {50.0, -50.0, 100.0, 0.0}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Scene scene{.up = milliseconds(5),
                        .down = milliseconds(40),
                        .jitter = milliseconds(20),
                        .drift_ppm = drift_ppm,
                        .loss = 0.3};
      Pair pair(scene, seed);
      for (int i = 0; i < 50 * 60 * 10; ++i) {
        pair.slot();
        if (!pair.sync.known()) continue;
        const Duration error = size(pair.error(pair.now()));
        ASSERT_LE(error, pair.sync.bound(pair.now())) << i << ' ' << drift_ppm;
        if (i < 250) continue;
        ASSERT_LE(error, milliseconds(5) + (scene.down - scene.up) / 2) << i;
        ASSERT_LE(pair.sync.bound(pair.now()), milliseconds(27)) << i;
      }
    }
  }
}

TEST(ClockSync, OneWayDelaysOfASymmetricLinkAreRight) {
  Pair pair({.jitter = milliseconds(20), .drift_ppm = 50.0, .loss = 0.3}, 9);
  std::vector<std::int64_t> errors_us;
  for (int i = 0; i < 50 * 60 * 5; ++i) {
    const auto error = pair.slot();
    if (error && i > 250) errors_us.push_back(size(*error).ns / 1'000);
  }
  std::sort(errors_us.begin(), errors_us.end());
  EXPECT_LE(errors_us[errors_us.size() * 99 / 100], 3'000);
}

// An hour is two wraps of tx_time and 180 ms of drift.
TEST(ClockSync, FollowsDriftOverWrapsOfTheTime) {
  Pair pair({.jitter = milliseconds(5), .drift_ppm = 50.0, .loss = 0.1}, 4);
  Duration before{};
  for (int i = 0; i < 50 * 3'600; ++i) {
    pair.slot();
    if (i == 50 * 60) before = pair.sync.offset();
    if (i <= 250) continue;
    ASSERT_LE(size(pair.error(pair.now())), milliseconds(3)) << i;
  }
  EXPECT_NEAR((pair.sync.offset() - before).milliseconds(), 50e-6 * 3'540 * 1e3, 4.0);
  EXPECT_EQ(pair.sync.contradictions(), 0U);
}

TEST(ClockSync, WrapsAndUnwraps) {
  const Duration wrap = microseconds(100) * (std::int64_t{1} << 24);
  std::mt19937_64 random(2);
  for (int i = 0; i < 10'000; ++i) {
    const Instant truth{static_cast<std::int64_t>(random() % 10'000'000'000'000'000)};
    const Duration off{static_cast<std::int64_t>(random() % 800'000'000'000)};
    const std::uint32_t wire = wrap_tx_time(truth);
    ASSERT_LT(wire, 1U << 24);
    for (const Instant near : {truth + off, truth - off}) {
      const Instant read = unwrap_tx_time(wire, near);
      ASSERT_LE(read, truth);
      ASSERT_LT(truth - read, microseconds(100));
    }
    ASSERT_EQ(wrap_tx_time(truth + wrap), wire);
  }
  EXPECT_LE(unwrap_tx_time(0xFF'FFFF, Instant{}), Instant{});
}

// Of the peers' defects: one stamp from the future locked the operator out for good.
TEST(ClockSync, OnePacketFromTheFutureLocksNobodyOut) {
  Pair pair({.jitter = milliseconds(5)}, 5);
  for (int i = 0; i < 500; ++i) pair.slot();
  const Duration offset = pair.sync.offset();
  const Instant now = pair.now();
  const Duration ahead = seconds(700);
  const Instant stamped =
      pair.sync.peer_time(wrap_tx_time(pair.theirs(now) + ahead), now + milliseconds(15));
  EXPECT_GT(pair.sync.to_own(stamped) - now, ahead - seconds(1));  // its own figure is off
  pair.sync.note({now - milliseconds(30), stamped - milliseconds(5), stamped, now});
  EXPECT_LE(size(pair.sync.offset() - offset), milliseconds(1));
  EXPECT_EQ(pair.sync.contradictions(), 1U);
  for (int i = 0; i < 100; ++i) {
    const auto error = pair.slot();
    ASSERT_TRUE(error && size(*error) < milliseconds(5));
  }
}

TEST(ClockSync, AClockThatStepsForGoodIsBelievedSoon) {
  Pair before({.jitter = milliseconds(5)}, 6);
  for (int i = 0; i < 500; ++i) before.slot();
  Pair after({.jitter = milliseconds(5), .theirs_at_start = seconds(400)}, 6);
  after.sync = before.sync;
  for (int i = 0; i < 510; ++i) after.slot();
  EXPECT_LE(size(after.error(after.now())), milliseconds(5));
  EXPECT_GT(after.sync.contradictions(), 0U);
}

TEST(ClockSync, ImpossibleExchangesCountAndChangeNothing) {
  ClockSync sync;
  const auto at = [](std::int64_t ms) { return Instant{} + milliseconds(ms); };
  sync.note({at(100), at(50), at(60), at(90)});     // received before it was sent
  sync.note({at(0), at(60), at(50), at(90)});       // they sent before they received
  sync.note({at(0), at(50), at(500), at(90)});      // a round trip below zero
  sync.note({at(0), at(0), at(0), at(3'600'000)});  // an hour
  EXPECT_FALSE(sync.known());
  EXPECT_EQ(sync.contradictions(), 4U);
  sync.note({at(0), at(50), at(60), at(90)});
  EXPECT_TRUE(sync.known());
  EXPECT_EQ(sync.round_trip(), milliseconds(80));
  sync.forget();
  EXPECT_FALSE(sync.known());
}

}  // namespace
}  // namespace pitwall::telemetry
