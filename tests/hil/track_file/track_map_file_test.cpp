// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/track_map_file.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/file.hpp"

namespace pitwall::track_file {
namespace {

TEST(TrackMapFile, IsTheMapOfTheFileOrTheReasonWhyThereIsNone) {
  const auto map =
      read_track_map(std::string(PITWALL_SOURCE_DIR) + "/vehicle/config/tracks/lvms.yaml");
  ASSERT_TRUE(map) << to_string(map.error());
  EXPECT_EQ(map->name(), "LVMS");
  EXPECT_NEAR(map->length_m(), 2454.3, 1.0);
  const auto folder = transport::TemporaryFolder::create("pitwall-track-");
  ASSERT_TRUE(folder);
  const std::string path = folder->path() + "/t.yaml";
  EXPECT_FALSE(read_track_map(path)) << "there is none yet";
  ASSERT_TRUE(transport::write_file(path, "name: x\nlength_m: -1\n"));
  const auto refused = read_track_map(path);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().place.find("t.yaml:2"), std::string::npos) << refused.error().place;
}

}  // namespace
}  // namespace pitwall::track_file
