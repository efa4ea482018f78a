// The test vectors of libspiro for closed splines whose points are all continuous to G4; those of
// corners and half-continuous points are for curves that no raceline has.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "protocol/json/json_value.hpp"
#include "tests/support/public_data.hpp"
#include "vehicle/raceline/spline/spiro_spline.hpp"

namespace pitwall::raceline {
namespace {

constexpr double kVectorTolerance =
    1e-5;  // of libspiro's own test; relative, for points of any size

std::vector<Place> points_of(const json::JsonValue::Items& rows) {
  std::vector<Place> points;
  for (const json::JsonValue& row : rows)
    points.push_back({row.items()[0].number(), row.items()[1].number()});
  return points;
}

bool is_closed_g4(const json::JsonValue& vector) {
  if (!vector.flag("closed")) return false;
  for (const json::JsonValue& row : vector.items("control_points_x_y_type"))
    if (row.items()[2].text() != "o") return false;
  return true;
}

TEST(PublicSpiro, EqualsTheVectorsOfLibspiro) {
  using recordings::kSpiro;
  if (!recordings::is_here(kSpiro)) GTEST_SKIP() << recordings::how_to_get(kSpiro);
  std::stringstream text;
  text << std::ifstream(recordings::path_of(kSpiro)).rdbuf();
  const auto file = json::JsonValue::parse(text.str(), kSpiro.path);
  ASSERT_TRUE(file) << to_string(file.error());
  int compared = 0;
  for (const json::JsonValue& vector : file->items("cases")) {
    if (!is_closed_g4(vector)) continue;
    const std::string name = vector.text("test");
    const auto spline = SpiroSpline::through(points_of(vector.items("control_points_x_y_type")));
    ASSERT_TRUE(spline) << name << ": " << to_string(spline.error());
    const auto& expected = vector.items("expected_bend_chord_theta_per_segment");
    ASSERT_EQ(spline->segments().size(), expected.size()) << name;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const SpiroSegment& s = spline->segments()[i];
      const auto& row = expected[i].items();
      EXPECT_NEAR(s.bend_rad, row[0].number(), kVectorTolerance) << name << " " << i;
      EXPECT_NEAR(s.chord_m / row[1].number(), 1.0, kVectorTolerance) << name << " " << i;
      EXPECT_NEAR(wrap_pi(s.chord_yaw_rad - row[2].number()), 0.0, kVectorTolerance)
          << name << " " << i;
      // All of them are circles, whose curvature over a segment is its turn.
      EXPECT_NEAR(s.k[0], row[0].number(), kVectorTolerance) << name << " " << i;
    }
    ++compared;
  }
  EXPECT_EQ(compared, 3);
  EXPECT_FALSE(SpiroSpline::through(points_of(file->items("path3_must_fail"))));
}

}  // namespace
}  // namespace pitwall::raceline
