// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/lidar_error_file.hpp"

#include <gtest/gtest.h>

namespace pitwall::scenario {
namespace {

const std::string kGoodErrors = R"(detector: pillar network
false_per_sweep: 0.05
ranges:
  - {from_m: 0, to_m: 20, found: 0.99, position_rms_m: 0.12, yaw_rms_deg: 1.5}
  - {from_m: 20, to_m: 100, found: 0.9, position_rms_m: 0.3, yaw_rms_deg: 3}
)";

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kGoodErrors;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(LidarErrorFile, IsReadAsItStands) {
  const auto errors = read_lidar_errors(kGoodErrors, "e.yaml");
  ASSERT_TRUE(errors) << to_string(errors.error());
  EXPECT_EQ(errors->false_per_sweep, 0.05);
  ASSERT_EQ(errors->rows.size(), 2U);
  EXPECT_EQ(errors->rows[1].from_m, 20.0);
  EXPECT_EQ(errors->rows[1].to_m, 100.0);
  EXPECT_EQ(errors->rows[1].found_share, 0.9);
  EXPECT_EQ(errors->rows[1].position_rms_m, 0.3);
  EXPECT_EQ(errors->rows[1].yaw_rms_rad, from_deg(3.0));
}

TEST(LidarErrorFile, AMistakeIsNamedWithItsPlace) {
  for (const auto& [from, to] :
       {std::pair{"found: 0.9,", "found: 1.1,"}, std::pair{"from_m: 20", "from_m: 30"},
        std::pair{"to_m: 20", "to_m: 0"}, std::pair{"yaw_rms_deg: 3", "yaw_rms_rad: 3"},
        std::pair{"false_per_sweep: 0.05\n", ""}, std::pair{"detector: pillar network\n", ""}}) {
    const auto refused = read_lidar_errors(replaced(from, to), "e.yaml");
    ASSERT_FALSE(refused) << to;
    EXPECT_TRUE(refused.error().place.starts_with("e.yaml")) << refused.error().place;
  }
  EXPECT_FALSE(read_lidar_errors("detector: x\nfalse_per_sweep: 0\nranges: []\n", "e.yaml"));
}

}  // namespace
}  // namespace pitwall::scenario
