// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/apex_file.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/raceline/courses.hpp"

namespace pitwall::raceline {
namespace {

Result<ChosenApexes, Problem> read(const std::string& text) {
  return read_apexes(text, "apexes.yaml", valid(world::TrackMap::build(stadium())));
}

TEST(ApexFile, GivesTheApexesInTheirOrder) {
  const ChosenApexes apexes =
      valid(read("inner:\n  - {s_m: 2050, n_m: 5}\n  - {s_m: 700.5, n_m: -1.5}\n"));
  ASSERT_EQ(apexes.inner.size(), 2U);
  EXPECT_EQ(apexes.inner[0].s_m, 700.5);
  EXPECT_EQ(apexes.inner[0].n_m, -1.5);
  EXPECT_EQ(apexes.inner[1].s_m, 2050.0);
  EXPECT_TRUE(apexes.outer.empty());
  EXPECT_EQ(valid(read("outer: [{s_m: 1, n_m: 2}]")).outer.size(), 1U);
}

TEST(ApexFile, RefusesWithItsPlace) {
  const auto what = [](const std::string& text) {
    const auto apexes = read(text);
    return apexes ? "" : to_string(apexes.error());
  };
  const std::string far = what("inner:\n  - {s_m: 9999, n_m: 5}\n");
  EXPECT_EQ(far.substr(0, 16), "apexes.yaml:2:11") << far;
  EXPECT_NE(what("inner: [{s_m: 700, n_m: 8.5}]").find("8.5"), std::string::npos);  // in the wall
  const std::string close = what("outer:\n  - {s_m: 5, n_m: 0}\n  - {s_m: 2410, n_m: 0}\n");
  EXPECT_NE(close.find("is closer than 30 m to another apex of the lane"), std::string::npos)
      << close << " " << stadium().length_m;
  EXPECT_NE(what("middle: []").find("middle"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::raceline
