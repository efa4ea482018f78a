// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/track_fingerprint.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "tests/vehicle/raceline/courses.hpp"

namespace pitwall::raceline {
namespace {

TEST(TrackFingerprint, IsThatOfTheNumbersAndTheName) {
  const std::string own = fingerprint_of(stadium());
  EXPECT_EQ(own.size(), 64U);
  world::TrackDescription moved = stadium();
  moved.source = "elsewhere/stadium.yaml";
  EXPECT_EQ(fingerprint_of(moved), own);
}

TEST(TrackFingerprint, ChangesWithEachOfThem) {
  using Description = world::TrackDescription;
  std::set<std::string> seen{fingerprint_of(stadium())};
  const std::vector<std::function<void(Description&)>> changes{
      [](Description& d) { d.name += "2"; },
      [](Description& d) { d.length_m += 1e-3; },
      [](Description& d) { d.datum_latitude_deg += 1e-9; },
      [](Description& d) { d.datum_longitude_deg += 1e-9; },
      [](Description& d) { d.datum_height_m += 1e-3; },
      [](Description& d) { d.start_x_m += 1e-3; },
      [](Description& d) { d.start_y_m += 1e-3; },
      [](Description& d) { d.start_yaw_rad += 1e-9; },
      [](Description& d) { d.knots[3].s_m += 1e-3; },
      [](Description& d) { d.knots[3].curvature_per_m += 1e-9; },
      [](Description& d) { d.knots[3].bank_rad += 1e-9; },
      [](Description& d) { d.knots[3].width_left_m += 1e-3; },
      [](Description& d) { d.knots[3].width_right_m += 1e-3; },
      [](Description& d) { d.knots.pop_back(); },
      [](Description& d) { d.pit->entry_s_m += 1e-3; },
      [](Description& d) { d.pit->exit_s_m += 1e-3; },
      [](Description& d) { d.pit->offset_m += 1e-3; },
      [](Description& d) { d.pit->width_m += 1e-3; },
      [](Description& d) { d.pit->speed_limit_mps += 1e-3; },
      [](Description& d) { d.pit.reset(); }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Description changed = stadium();
    changes[i](changed);
    EXPECT_TRUE(seen.insert(fingerprint_of(changed)).second) << i;
  }
}

}  // namespace
}  // namespace pitwall::raceline
