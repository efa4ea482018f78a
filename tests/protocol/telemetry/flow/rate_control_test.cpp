// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/rate_control.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <type_traits>

#include "tests/protocol/telemetry/flow/slot.hpp"
#include "tests/support/draw.hpp"

namespace pitwall::telemetry {
namespace {

static_assert(std::is_trivially_copyable_v<RateControl>);

constexpr double kBudget = 32'000.0, kFloor = 4'400.0;

// A sender that uses all that it is left, a serial air with a queue before it, and random loss
// after it. Delays as the acknowledgements tell them.
class Air {
 public:
  Air(double capacity_bytes_per_s, double loss, Duration jitter, std::uint64_t seed)
      : capacity_(capacity_bytes_per_s), loss_(loss), jitter_(jitter), random_(seed) {}

  void run(RateControl& rate, Duration length, double offered = 1.0) {
    for (const Instant end = now_ + length; now_ < end; now_ += kSlot) {
      const auto bytes =
          static_cast<std::size_t>(kBudget * offered * rate.factor() * kSlot.seconds());
      free_ = std::max(free_, now_) + from_seconds(static_cast<double>(bytes) / capacity_);
      worst_queue_ = std::max(worst_queue_, free_ - now_);
      pending_ += bytes;
      if (chance() < loss_) {
        pending_ -= bytes;
        continue;
      }
      const Duration jitter{static_cast<std::int64_t>(chance() * static_cast<double>(jitter_.ns))};
      const Instant arrives = free_ + milliseconds(15) + jitter;
      rate.delivered(now_, arrives + seconds(5'000), pending_, arrives + milliseconds(30));
      pending_ = 0;
      least_factor_ = std::min(least_factor_, rate.factor());
    }
  }
  void set_capacity(double bytes_per_s) { capacity_ = bytes_per_s; }
  void wait(Duration d) { now_ += d; }
  double least_factor() const { return least_factor_; }
  Duration worst_queue() const { return worst_queue_; }
  Duration queue() const { return std::max(Duration{}, free_ - now_); }

 private:
  double chance() { return testing::draw_uniform(random_); }

  double capacity_, loss_;
  Duration jitter_;
  std::mt19937_64 random_;
  Instant now_ = Instant{} + seconds(100);
  Instant free_{};
  std::size_t pending_ = 0;
  double least_factor_ = 1.0;
  Duration worst_queue_{};
};

TEST(RateControl, LossWithoutAQueueChangesNothing) {
  for (const double loss : {0.0, 0.3, 0.5, 0.8}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      RateControl rate(kBudget, kFloor);
      Air air(kBudget * 1.1, loss, milliseconds(20), seed);
      air.run(rate, seconds(300));
      EXPECT_EQ(air.least_factor(), 1.0) << loss << ' ' << seed;
      EXPECT_EQ(rate.backoffs(), 0U);
    }
  }
}

TEST(RateControl, FadesChangeNothing) {
  RateControl rate(kBudget, kFloor);
  Air air(kBudget * 1.05, 0.02, milliseconds(10), 3);
  for (int i = 0; i < 200; ++i) {
    air.run(rate, milliseconds(280));
    air.wait(milliseconds(120));
  }
  EXPECT_EQ(air.least_factor(), 1.0);
}

TEST(RateControl, AQueueThatGrowsIsBroughtDownAndTheRateComesBack) {
  for (const double loss : {0.0, 0.3}) {
    RateControl rate(kBudget, kFloor);
    Air air(kBudget, loss, milliseconds(5), 2);
    air.run(rate, seconds(5), 0.9);
    ASSERT_EQ(rate.factor(), 1.0);
    air.set_capacity(kBudget / 1.2);  // 120 % load
    air.run(rate, milliseconds(1'200));
    EXPECT_LT(rate.factor(), 0.85) << loss;
    EXPECT_LE(air.worst_queue(), milliseconds(320));
    air.run(rate, seconds(4));
    EXPECT_LE(air.queue(), milliseconds(100));
    EXPECT_GE(rate.factor(), kFloor / kBudget);

    air.set_capacity(kBudget * 1.1);
    air.run(rate, seconds(15));
    EXPECT_EQ(rate.factor(), 1.0);
  }
}

// What a fade swallows does not count against the link.
TEST(RateControl, BetweenFadesTheRateIsTheLinks) {
  RateControl rate(kBudget, kFloor);
  Air air(kBudget * 0.7, 0.0, milliseconds(5), 6);
  double sum = 0.0;
  for (int i = 0; i < 100; ++i) {
    air.run(rate, milliseconds(280));
    air.wait(milliseconds(120));
    sum += i >= 20 ? rate.factor() : 0.0;
  }
  EXPECT_GT(rate.backoffs(), 0U);
  EXPECT_GT(sum / 80, 0.45);
  EXPECT_LT(sum / 80, 1.0);
}

TEST(RateControl, StaysNearTheCapacityOfALinkThatIsSmallerThanTheBudget) {
  RateControl rate(kBudget, kFloor);
  Air air(kBudget * 0.5, 0.0, milliseconds(5), 8);
  air.run(rate, seconds(10));
  double sum = 0.0;
  const int slots = 100;
  for (int i = 0; i < slots; ++i) {
    air.run(rate, milliseconds(200));
    sum += rate.factor();
    EXPECT_LE(air.queue(), milliseconds(250));
  }
  EXPECT_GT(sum / slots, 0.35);
  EXPECT_LT(sum / slots, 0.55);
}

TEST(RateControl, NeverGoesBelowTheFloor) {
  RateControl rate(kBudget, kFloor);
  Air air(500.0, 0.0, {}, 1);
  air.run(rate, seconds(20));
  EXPECT_GE(rate.factor(), kFloor / kBudget);
  EXPECT_GT(rate.backoffs(), 0U);
}

TEST(RateControl, OldNewsIsNoNews) {
  RateControl rate(kBudget, kFloor);
  const Instant t = Instant{} + seconds(1);
  rate.delivered(t, t, 100, t);
  rate.delivered(t - seconds(1), t - seconds(1), 100, t);
  rate.delivered(t, t, 100, t);
  EXPECT_EQ(rate.queue_delay(), Duration{});
  EXPECT_EQ(rate.factor(), 1.0);
}

}  // namespace
}  // namespace pitwall::telemetry
