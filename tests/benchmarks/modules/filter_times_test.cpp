// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/modules/filter_times.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "tests/vehicle/autonomy/localization/oval.hpp"

namespace pitwall::benchmarks {
namespace {

using localization::FilterKind, localization::FilterParams, localization::FilterState,
    localization::Kind;

// A filter that has driven for two seconds.
std::unique_ptr<FilterState> driven(const FilterParams& params) {
  auto state = std::make_unique<FilterState>();
  localization::testing::OvalDrive drive(localization::testing::Oval{}, 1);
  const auto all = drive.run(2.0);
  start(*state, params, drive.seed());
  for (const auto& arrival : all) (void)insert(*state, params, arrival.measurement);
  return state;
}

TEST(FilterTimes, EveryCallOfTheWindowIsTimedAndTheFilterIsLeftAlone) {
  for (const FilterKind kind : {FilterKind::kSpatial, FilterKind::kPlanar}) {
    FilterParams params = localization::testing::recommended_filter();
    params.kind = kind;
    params.window_s = localization::kWindowMost_s;
    const auto state = driven(params);
    const auto before = std::make_unique<FilterState>(*state);
    FilterTimes times;
    take_times(*state, params, times);
    EXPECT_EQ(std::memcmp(before.get(), state.get(), sizeof *state), 0);
    EXPECT_EQ(times.refused, 0u);
    EXPECT_EQ(times.short_rewind_us.size(), 1u);
    EXPECT_EQ(times.long_rewind_us.size(), 1u);
    EXPECT_GE(times.predict_us.size(), 135u);  // 1.1 s at 125 Hz
    for (const Kind measured : {Kind::kPosition, Kind::kVelocity, Kind::kWheelSpeed})
      EXPECT_GT(times.update_us[static_cast<std::size_t>(measured)].size(), 10u);
  }
}

TEST(FilterTimes, WhatTheWindowDoesNotReachIsCountedAsRefused) {
  FilterParams params = localization::testing::recommended_filter();
  params.window_s = 0.25;
  FilterTimes times;
  take_times(*driven(params), params, times);
  EXPECT_EQ(times.short_rewind_us.size(), 1u);
  EXPECT_TRUE(times.long_rewind_us.empty());
  EXPECT_EQ(times.refused, 1u);
}

}  // namespace
}  // namespace pitwall::benchmarks
