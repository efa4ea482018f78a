// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/track_document.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/json/json_value.hpp"
#include "protocol/transport/file.hpp"
#include "vehicle/parameters/track_file.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::publishers::console {
namespace {

using Points = std::vector<json::JsonValue>;

double at(const json::JsonValue& point, std::size_t i) { return point.items()[i].number(); }

double between(const json::JsonValue& a, const json::JsonValue& b) {
  return std::hypot(at(a, 0) - at(b, 0), at(a, 1) - at(b, 1));
}

class Track : public ::testing::TestWithParam<const char*> {
 protected:
  std::string path_ =
      std::string{PITWALL_SOURCE_DIR} + "/vehicle/config/tracks/" + GetParam() + ".yaml";
};

TEST_P(Track, LiesWhereTheCarsOwnMapHasIt) {
  const auto track = read_track(path_);
  ASSERT_TRUE(track) << to_string(track.error());
  const auto described = parameters::read_track(*transport::read_file(path_), path_);
  ASSERT_TRUE(described);
  const auto car = world::TrackMap::build(*described);
  ASSERT_TRUE(car);
  EXPECT_EQ(track->datum.latitude_deg, described->datum_latitude_deg);
  EXPECT_EQ(track->datum.longitude_deg, described->datum_longitude_deg);
  EXPECT_EQ(track->datum.height_m, described->datum_height_m);
  const auto drawn = json::JsonValue::parse(track->json, "track");
  ASSERT_TRUE(drawn);
  double worst_m = 0.0;
  for (const json::JsonValue& point : drawn->items("centre")) {
    const auto there = car->at(at(point, 2));
    worst_m = std::max(worst_m, std::hypot(there.x_m - at(point, 0), there.y_m - at(point, 1)));
  }
  EXPECT_LT(worst_m, 3.0);
}

TEST_P(Track, IsClosedWithWallsBesideEachPointAndCorners) {
  const auto track = read_track(path_);
  ASSERT_TRUE(track);
  const auto drawn = json::JsonValue::parse(track->json, "track");
  const auto& centre = drawn->items("centre");
  ASSERT_GT(centre.size(), 400u);
  ASSERT_EQ(drawn->items("left").size(), centre.size());
  ASSERT_EQ(drawn->items("right").size(), centre.size());
  for (std::size_t i = 0; i < centre.size(); ++i) {
    EXPECT_NEAR(between(centre[i], centre[(i + 1) % centre.size()]), 5.0, 5.0);
    EXPECT_GT(between(drawn->items("left")[i], drawn->items("right")[i]), 8.0);
  }
  EXPECT_GT(drawn->items("pit").size(), 10u);
  EXPECT_GE(drawn->items("corners").size(), 2u);
  EXPECT_NEAR(track->course->length_m(), drawn->number("length_m"), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All, Track, ::testing::Values("lvms", "ims", "tms"));

TEST(TrackFile, AMistakeIsNamedByItsPlace) {
  const auto folder = transport::TemporaryFolder::create("track");
  ASSERT_TRUE(folder);
  const std::string path = folder->path() + "/t.yaml";
  ASSERT_TRUE(transport::write_file(path, "name: X\nlength_m: -1\n"));
  const auto track = read_track(path);
  ASSERT_FALSE(track);
  EXPECT_NE(track.error().place.find("t.yaml:2"), std::string::npos) << track.error().place;
  EXPECT_FALSE(read_track(folder->path() + "/none.yaml"));
}

}  // namespace
}  // namespace pitwall::publishers::console
