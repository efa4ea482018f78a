// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/params.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/autonomy/localization/recommended.hpp"

namespace pitwall::localization {
namespace {

std::string place(void (*change)(Params&)) {
  Params p = testing::recommended();
  change(p);
  const auto result = checked(p);
  return result ? "legal" : result.error().place;
}

TEST(Params, RecommendedOnesAreLegalAndUnsetOnesAreNot) {
  EXPECT_EQ(place([](Params&) {}), "legal");
  EXPECT_NE(place([](Params& p) { p = Params{}; }), "legal");
}

TEST(Params, TheOffenderIsNamed) {
  EXPECT_EQ(place([](Params& p) { p.units[1].antenna.z_m = 7.0; }), "units[1].antenna.z_m");
  EXPECT_EQ(place([](Params& p) { p.units[0].baseline_yaw_rad = kUnset; }),
            "units[0].baseline_yaw_rad");
  EXPECT_EQ(place([](Params& p) { p.filter.window_s = 0.0; }), "filter.window_s");
  EXPECT_EQ(place([](Params& p) { p.checks.jump_sigmas = 1.0; }), "checks.jump_sigmas");
  EXPECT_EQ(place([](Params& p) { p.reset_after_s = kUnset; }), "reset_after_s");
  EXPECT_EQ(place([](Params& p) { p.bicycle.wheelbase_m = 9.0; }), "bicycle.wheelbase_m");
}

}  // namespace
}  // namespace pitwall::localization
