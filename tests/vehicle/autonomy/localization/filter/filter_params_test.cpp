// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/filter_params.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/autonomy/localization/recommended.hpp"

namespace pitwall::localization {
namespace {

using testing::recommended_filter;

std::string place(const FilterParams& p) {
  const auto problem = illegal(p);
  return problem ? problem->place : "legal";
}

TEST(FilterParams, RecommendedOnesAreLegal) {
  EXPECT_EQ(place(recommended_filter()), "legal");
  EXPECT_EQ(place(recommended_filter(FilterKind::kPlanar)), "legal");
}

// Each number of the tables alone is refused outside its range and when unset, by its name.
template <class Table, class Pick>
void expect_each_refused(const Table& table, const std::string& prefix, Pick pick) {
  for (const auto& r : table) {
    for (const double bad : {kUnset, r.least - 1e-9 - 0.1 * std::abs(r.least), r.most * 1.1}) {
      FilterParams p = recommended_filter();
      pick(p).*r.value = bad;
      EXPECT_EQ(place(p), prefix + r.name) << bad;
    }
    for (const double good : {r.least, r.most}) {
      FilterParams p = recommended_filter();
      pick(p).*r.value = good;
      EXPECT_EQ(place(p), "legal") << r.name;
    }
  }
}

TEST(FilterParams, EachHasItsRange) {
  expect_each_refused(kMotionNoiseRanges, "filter.planar.",
                      [](FilterParams& p) -> MotionNoise& { return p.planar.noise; });
  expect_each_refused(kPlanarRanges, "filter.planar.",
                      [](FilterParams& p) -> PlanarParams& { return p.planar; });
  expect_each_refused(kSpatialRanges, "filter.spatial.",
                      [](FilterParams& p) -> SpatialParams& { return p.spatial; });
}

TEST(FilterParams, GatesAndSharedOnesToo) {
  FilterParams p = recommended_filter();
  p.window_s = kWindowMost_s + 0.01;
  EXPECT_EQ(place(p), "filter.window_s");
  p = recommended_filter();
  p.reentry_mps = kUnset;
  EXPECT_EQ(place(p), "filter.reentry_mps");
  p = recommended_filter();
  p.planar.gate_nis[1] = 3.0;
  EXPECT_EQ(place(p), "filter.planar.gate_nis[1]");
  p = recommended_filter();
  p.spatial.gate_nis[2] = kUnset;
  EXPECT_EQ(place(p), "filter.spatial.gate_nis[2]");
}

// No number can be forgotten: a table names as many as the struct holds, but for the gates and the
// rear axle's two.
TEST(FilterParams, TablesAreComplete) {
  EXPECT_EQ(kMotionNoiseRanges.size() * sizeof(double), sizeof(MotionNoise));
  EXPECT_EQ(kPlanarRanges.size() * sizeof(double),
            sizeof(PlanarParams) - sizeof(MotionNoise) - 4 * sizeof(double));
  EXPECT_EQ(kSpatialRanges.size() * sizeof(double), sizeof(SpatialParams) - 5 * sizeof(double));
}

}  // namespace
}  // namespace pitwall::localization
