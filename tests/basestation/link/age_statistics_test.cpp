// SPDX-License-Identifier: Apache-2.0
// Against one who really looks each millisecond.
#include "basestation/link/age_statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

namespace pitwall::link {
namespace {

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
