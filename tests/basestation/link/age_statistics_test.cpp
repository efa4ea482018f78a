// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/age_statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

namespace pitwall::link {
namespace {

TEST(AgeHistogram, IsZeroBeforeAnything) {
  const auto h = std::make_unique<AgeHistogram>();
  EXPECT_EQ(h->quantile(0.5), Duration{});
  EXPECT_EQ(h->largest(), Duration{});
}

// Oracle: the age looked at every 10 microseconds, sorted.
TEST(AgeHistogram, AgreesWithLookingAllTheTime) {
  const auto h = std::make_unique<AgeHistogram>();
  std::vector<std::int64_t> looks;
  std::uint64_t state = 12'345;
  for (int i = 0; i < 200; ++i) {
    state = state * 6'364'136'223'846'793'005ULL + 1'442'695'040'888'963'407ULL;
    const Duration from = microseconds(static_cast<std::int64_t>(state >> 33U) % 5'000);
    const Duration length = microseconds(1 + static_cast<std::int64_t>(state >> 43U) % 60'000);
    h->add(from, length);
    for (Duration t{}; t < length; t = t + microseconds(10)) looks.push_back((from + t).ns);
  }
  std::sort(looks.begin(), looks.end());
  for (const double q : {0.1, 0.5, 0.9, 0.99}) {
    const auto at = static_cast<std::size_t>(q * static_cast<double>(looks.size() - 1));
    EXPECT_NEAR(h->quantile(q).milliseconds(), static_cast<double>(looks[at]) * 1e-6, 1.1) << q;
  }
  EXPECT_NEAR(h->largest().milliseconds(), static_cast<double>(looks.back()) * 1e-6, 0.02);
}

TEST(AgeHistogram, AgesBeyondTheLastBucketAreKeptThere) {
  const auto h = std::make_unique<AgeHistogram>();
  h->add(seconds(3'600), seconds(10));
  EXPECT_EQ(h->largest(), seconds(3'610));
  EXPECT_GE(h->quantile(0.5), seconds(10));
  h->add(milliseconds(5), Duration{});
  h->add(milliseconds(5), milliseconds(-3));
  EXPECT_GE(h->quantile(0.01), seconds(10));
}

using telemetry::Class;
using telemetry::Group;

TEST(AgeStatistics, SaysWhatOneWhoLooksEachMillisecondSees) {
  std::mt19937_64 random(3);
  const auto book = std::make_unique<AgeStatistics>();
  telemetry::Snapshot state;
  std::vector<Duration> looks;
  Instant next{seconds(1).ns};
  for (Instant now{seconds(1).ns}; now < Instant{seconds(61).ns}; now += milliseconds(1)) {
    if (state.ever(Group::kEgo)) looks.push_back(now - state.at(Group::kEgo));
    if (now < next) continue;
    state.at(Group::kEgo) = now - milliseconds(static_cast<std::int64_t>(random() % 30));
    book->show(state, now);
    next = now + milliseconds(static_cast<std::int64_t>(1 + random() % 200));
  }
  book->advance(Instant{seconds(61).ns});
  std::sort(looks.begin(), looks.end());
  for (const double q : {0.5, 0.9, 0.99}) {
    const auto at = static_cast<std::size_t>(q * static_cast<double>(looks.size()));
    const double seen_ms = looks[at].milliseconds();
    EXPECT_NEAR(book->of(Group::kEgo).quantile(q).milliseconds(), seen_ms, 1.5) << q;
  }
  EXPECT_NEAR(book->of(Group::kEgo).largest().milliseconds(), looks.back().milliseconds(), 1.0);
  EXPECT_EQ(book->of(Class::kMotion).largest(), book->of(Group::kEgo).largest());
  EXPECT_EQ(book->of(Class::kSafety).largest(), Duration{});
}

TEST(AgeStatistics, ACarThatRestartedLeavesWhatIsShownToAge) {
  const auto book = std::make_unique<AgeStatistics>();
  telemetry::Snapshot state;
  state.at(Group::kMode) = Instant{seconds(1).ns};
  book->show(state, Instant{seconds(1).ns});
  book->show(telemetry::Snapshot{}, Instant{seconds(2).ns});
  book->advance(Instant{seconds(4).ns});
  EXPECT_EQ(book->of(Group::kMode).largest(), seconds(3));
}

}  // namespace
}  // namespace pitwall::link
