// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/filter_window.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/vehicle/autonomy/localization/recommended.hpp"

namespace pitwall::localization {
namespace {

// A filter that only remembers what it was told, and what it could see ahead.
struct Chronicle {
  struct Belief {
    std::uint64_t reported = 0;
    std::uint32_t folds = 0;
  };
  struct Params {};
  static inline std::uint32_t folds = 0;

  static Innovation fold(Belief& b, const Params&, const Measurement& m, const Measurement* ahead) {
    const auto mix = [&b](std::int64_t x) {
      b.reported = (b.reported ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ULL;
    };
    mix(m.at.ns);
    mix(static_cast<std::int64_t>(m.kind));
    mix(ahead != nullptr ? ahead->at.ns : -1);
    ++b.folds;
    ++folds;
    return {.accepted = true, .nis = static_cast<double>(m.at.ns), .size = 1};
  }
};

using Reported = Memory<Chronicle::Belief>;
constexpr Duration kWindow = milliseconds(250);

Measurement measurement(Kind kind, std::int64_t ms) {
  return {.kind = kind, .at = Instant{ms * 1'000'000}, .a = 0.0};
}

// What a belief must be: everything from the start, in order, folded once.
std::uint64_t in_one_go(std::vector<Measurement> all) {
  std::sort(all.begin(), all.end(), before);
  Chronicle::Belief b;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Measurement* ahead = nullptr;
    for (std::size_t k = i; k < all.size() && ahead == nullptr; ++k)
      if (all[k].kind == Kind::kImu) ahead = &all[k];
    (void)Chronicle::fold(b, {}, all[i], ahead);
  }
  return b.reported;
}

struct Late {
  Measurement m;
  std::int64_t at_ms;
};

// Kinds at their rates, each delivered a random time after it was true.
std::vector<Late> drive(std::uint64_t seed, std::int64_t latest_ms) {
  Random random{seed};
  std::vector<Late> all;
  for (std::int64_t ms = 1; ms < 3000; ++ms) {
    const auto say = [&](Kind kind) {
      all.push_back(
          {measurement(kind, ms),
           ms + static_cast<std::int64_t>(random.uniform() * static_cast<double>(latest_ms))});
    };
    if (ms % 8 == 0) say(Kind::kImu);
    if (ms % 10 == 5) say(Kind::kWheelSpeed), say(Kind::kSlip);
    if (ms % 50 == 20) say(Kind::kPosition);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Late& a, const Late& b) { return a.at_ms < b.at_ms; });
  return all;
}

TEST(FilterWindow, IsAFoldWhateverTheOrder) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Entries e;
    Reported reported;
    begin(e, reported, Chronicle::Belief{}, Instant{});
    std::vector<Measurement> known;
    for (const Late& late : drive(seed, 200)) {
      const auto innovation = insert_into<Chronicle>(e, reported, {}, kWindow, late.m);
      ASSERT_TRUE(innovation.has_value());
      if (!is_quiet(late.m.kind)) {
        ASSERT_EQ(innovation->nis, static_cast<double>(late.m.at.ns));  // its own
      }
      known.push_back(late.m);
      if (known.size() % 37 != 0) continue;
      settle<Chronicle>(e, reported, {});
      ASSERT_EQ(reported.tip.reported, in_one_go(known)) << seed << ": " << known.size();
    }
  }
}

TEST(FilterWindow, RefusesWhatIsOlderThanItsFirstEntry) {
  Entries e;
  Reported reported;
  begin(e, reported, Chronicle::Belief{}, Instant{} + seconds(1));
  EXPECT_FALSE(insert_into<Chronicle>(e, reported, {}, kWindow, measurement(Kind::kPosition, 999)));
  for (std::int64_t ms = 1001; ms < 3000; ms += 4)
    ASSERT_TRUE(insert_into<Chronicle>(e, reported, {}, kWindow, measurement(Kind::kPosition, ms)));
  settle<Chronicle>(e, reported, {});
  const std::uint64_t before_it = reported.tip.reported;
  EXPECT_TRUE(insert_into<Chronicle>(e, reported, {}, kWindow, measurement(Kind::kHeading, 2760)));
  settle<Chronicle>(e, reported, {});
  EXPECT_NE(reported.tip.reported, before_it);
  EXPECT_FALSE(insert_into<Chronicle>(e, reported, {}, kWindow, measurement(Kind::kHeading, 2600)));
}

TEST(FilterWindow, MoreThanItHoldsShortensItAndLosesNothing) {
  Entries e;
  Reported reported;
  begin(e, reported, Chronicle::Belief{}, Instant{});
  std::vector<Measurement> known;
  for (std::int64_t i = 1; i < 2000; ++i) {
    Measurement m = measurement(i % 3 == 0 ? Kind::kImu : Kind::kRoad, 0);
    m.at = Instant{i * 100'000};
    known.push_back(m);
    ASSERT_TRUE(insert_into<Chronicle>(e, reported, {}, kWindow, m));
    ASSERT_LE(e.size, kEntries);
  }
  settle<Chronicle>(e, reported, {});
  EXPECT_EQ(reported.tip.reported, in_one_go(known));
}

// In order, nothing is done more often than the look ahead needs.
TEST(FilterWindow, WorkIsInProportionToWhatIsLate) {
  const auto folds_for = [](std::int64_t latest_ms) {
    Entries e;
    Reported reported;
    begin(e, reported, Chronicle::Belief{}, Instant{});
    Chronicle::folds = 0;
    const auto all = drive(3, latest_ms);
    for (const Late& late : all) (void)insert_into<Chronicle>(e, reported, {}, kWindow, late.m);
    settle<Chronicle>(e, reported, {});
    return static_cast<double>(Chronicle::folds) / static_cast<double>(all.size());
  };
  EXPECT_LT(folds_for(1), 6.0);
  EXPECT_LT(folds_for(40), 3.0 * static_cast<double>(kMemoStride));
}

}  // namespace
}  // namespace pitwall::localization
