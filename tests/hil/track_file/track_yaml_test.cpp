// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/track_yaml.hpp"

#include <gtest/gtest.h>

#include "tests/hil/track_file/shipped_track.hpp"
#include "vehicle/parameters/track_file.hpp"

namespace pitwall::track_file {
namespace {

TEST(TrackYaml, IsReadAsWhatWasWritten) {
  for (const char* name : {"lvms.yaml", "ims.yaml", "tms.yaml"}) {
    const auto d = shipped_track(name);
    const auto back = parameters::read_track(to_yaml(d, {"a remark"}), "back.yaml");
    ASSERT_TRUE(back) << to_string(back.error());
    EXPECT_EQ(back->name, d.name);
    EXPECT_NEAR(back->length_m, d.length_m, 1e-3);
    EXPECT_NEAR(back->datum_latitude_deg, d.datum_latitude_deg, 1e-8);
    EXPECT_NEAR(back->start_x_m, d.start_x_m, 1e-3);
    EXPECT_NEAR(back->start_yaw_rad, d.start_yaw_rad, 1e-6);
    ASSERT_EQ(back->pit.has_value(), d.pit.has_value());
    EXPECT_NEAR(back->pit->exit_s_m, d.pit->exit_s_m, 1e-3);
    ASSERT_EQ(back->knots.size(), d.knots.size());
    for (std::size_t i = 0; i < d.knots.size(); ++i) {
      EXPECT_NEAR(back->knots[i].s_m, d.knots[i].s_m, 1e-3);
      EXPECT_NEAR(back->knots[i].curvature_per_m, d.knots[i].curvature_per_m, 1e-9);
      EXPECT_NEAR(back->knots[i].bank_rad, d.knots[i].bank_rad, 2e-6);
      EXPECT_NEAR(back->knots[i].width_left_m, d.knots[i].width_left_m, 1e-3);
    }
  }
}

TEST(TrackYaml, ANameAndARemarkCannotBecomeKeys) {
  auto d = shipped_track("tms.yaml");
  d.name = "a \"b\": \\ # c\nlength_m: 1";
  const auto back = parameters::read_track(to_yaml(d, {"remark\nname: other"}), "back.yaml");
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_EQ(back->name, "a \"b\": \\ # c length_m: 1");
  EXPECT_NEAR(back->length_m, 2414.0, 1e-3);
}

}  // namespace
}  // namespace pitwall::track_file
