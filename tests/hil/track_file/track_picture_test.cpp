// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/track_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "tests/hil/track_file/shipped_track.hpp"

namespace pitwall::track_file {
namespace {

std::string picture(const world::TrackDescription& d) {
  const auto map = world::TrackMap::build(d);
  if (!map) throw std::runtime_error(to_string(map.error()));
  return picture_of(*map);
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(TrackPicture, ShowsEveryPart) {
  for (const char* name : {"lvms.yaml", "ims.yaml", "tms.yaml"}) {
    const auto d = shipped_track(name);
    const std::string svg = picture(d);
    EXPECT_EQ(svg.rfind("<svg ", 0), 0u);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    EXPECT_EQ(count(svg, "class=\"wall\""), 2u);
    for (const char* part : {"class=\"reference\"", "class=\"road\"", "class=\"stations\"",
                             "class=\"start\"", "class=\"direction\"", "class=\"legend\"",
                             "class=\"scale\"", "class=\"north\"", ">pit entry<", ">pit exit<"})
      EXPECT_NE(svg.find(part), std::string::npos) << part;
    const auto stations = svg.substr(svg.find("class=\"stations\""));
    EXPECT_EQ(count(stations.substr(0, stations.find("</g>")), "<line "),
              static_cast<std::size_t>(std::ceil(d.length_m / 100.0)));
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
  }
}

// Every number pair of every polygon lies inside of the picture.
TEST(TrackPicture, FitsItsFrame) {
  auto d = shipped_track("lvms.yaml");
  for (const double turned_rad : {0.0, 1.0, 2.5}) {
    d.start_yaw_rad += turned_rad;
    d.start_x_m += 4000.0;
    const std::string whole = picture(d);
    const std::string svg = whole.substr(0, whole.find("class=\"legend\""));
    static const std::regex kPair{R"((-?[0-9.]+),(-?[0-9.]+) )"};
    std::size_t pairs = 0;
    for (std::sregex_iterator i{svg.begin(), svg.end(), kPair}, end; i != end; ++i, ++pairs) {
      ASSERT_GT(std::stod((*i)[1]), 40.0);
      ASSERT_LT(std::stod((*i)[1]), 1240.0);
      ASSERT_GT(std::stod((*i)[2]), 60.0);
      ASSERT_LT(std::stod((*i)[2]), 780.0);
    }
    EXPECT_GT(pairs, 1000u);
  }
}

TEST(TrackPicture, NorthIsUpAndEastIsRight) {
  // TMS starts going east along its southern side: the arrow points right, in the lower half.
  const std::string svg = picture(shipped_track("tms.yaml"));
  static const std::regex kArrow{
      R"(class="direction" d="M([0-9.]+),([0-9.]+) L([0-9.]+),([0-9.]+))"};
  std::smatch m;
  ASSERT_TRUE(std::regex_search(svg, m, kArrow));
  EXPECT_GT(std::stod(m[3]), std::stod(m[1]) + 50.0);
  EXPECT_NEAR(std::stod(m[4]), std::stod(m[2]), 1.0);
  EXPECT_GT(std::stod(m[2]), 400.0);
}

TEST(TrackPicture, ANameIsNoMarkup) {
  auto d = shipped_track("tms.yaml");
  d.name = "<script>alert(1)</script> & more";
  const std::string svg = picture(d);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  EXPECT_NE(svg.find("&lt;script"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::track_file
