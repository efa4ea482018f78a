// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/rotation.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/vehicle/autonomy/localization/recommended.hpp"

namespace pitwall::localization {
namespace {

using Eigen::Vector3d;

Vector3d any(Random& random, double sigma) {
  const double x = testing::draw_normal(random), y = testing::draw_normal(random),
               z = testing::draw_normal(random);
  return sigma * Vector3d(x, y, z);
}

TEST(Rotation, LogarithmUndoesExponential) {
  Random random{1};
  for (const double sigma : {1e-10, 1e-7, 1e-3, 0.3, 0.9}) {
    for (int i = 0; i < 50; ++i) {
      const Vector3d v = any(random, sigma);
      if (v.norm() > 3.1) continue;
      EXPECT_NEAR(exp_rotation(v).norm(), 1.0, 1e-14);
      EXPECT_LT((log_rotation(exp_rotation(v)) - v).norm(), 1e-14 + 1e-12 * v.norm());
      Eigen::Quaterniond other = exp_rotation(v);
      other.coeffs() *= -1.0;  // the same rotation
      EXPECT_LT((log_rotation(other) - v).norm(), 1e-14 + 1e-12 * v.norm());
    }
  }
}

TEST(Rotation, ExponentialIsTheRotationAboutItsAxis) {
  Random random{1};
  for (int i = 0; i < 50; ++i) {
    const Vector3d v = any(random, 0.8), x = any(random, 1.0);
    const Vector3d turned = Eigen::AngleAxisd(v.norm(), v.normalized()) * x;
    EXPECT_LT((exp_rotation(v) * x - turned).norm(), 1e-13);
    EXPECT_LT((cross(v) * x - v.cross(x)).norm(), 1e-15);
  }
}

TEST(Rotation, AnglesAreThoseOfIso8855) {
  const double left = 0.5 * std::numbers::pi;
  const auto turned = [](Angles a, const Vector3d& v) -> Vector3d { return rotation_of(a) * v; };
  EXPECT_LT((turned({left, 0, 0}, Vector3d::UnitX()) - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT(turned({0, 0.1, 0}, Vector3d::UnitX()).z(), 0.0);  // nose down
  EXPECT_GT(turned({0, 0, 0.1}, Vector3d::UnitY()).z(), 0.0);  // left side up
  for (const Angles& a : {Angles{2.9, 0.3, -0.4}, Angles{-1.2, -0.2, 0.35}}) {
    const Angles b = angles_of(rotation_of(a).toRotationMatrix());
    EXPECT_NEAR(b.yaw_rad, a.yaw_rad, 1e-14);
    EXPECT_NEAR(b.pitch_rad, a.pitch_rad, 1e-14);
    EXPECT_NEAR(b.roll_rad, a.roll_rad, 1e-14);
  }
}

}  // namespace
}  // namespace pitwall::localization
