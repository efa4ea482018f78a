// SPDX-License-Identifier: Apache-2.0
// Whether the spatial filter knows how wrong it is: normalised estimation errors squared over
// twenty drives, against the bounds that chi-square gives them.
//   source Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and Navigation
//          (2001), section 5.4.2
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <memory>

#include "tests/vehicle/autonomy/localization/oval.hpp"
#include "vehicle/autonomy/localization/filter/ekf_3d_errors.hpp"
#include "vehicle/autonomy/localization/filter/filter.hpp"
#include "vehicle/autonomy/localization/filter/rotation.hpp"

namespace pitwall::localization {
namespace {

using testing::Oval;
using testing::OvalDrive;

constexpr int kSeeds = 20;
constexpr double kDrive_s = 30.0;
constexpr std::int64_t kEvery_ms = 4000, kFrom_ms = 10'000;

using Vector9 = Eigen::Matrix<double, 9, 1>;

// Position, attitude and velocity.
Vector9 error_of(const Oval& oval, const SpatialBelief& b, double t_s) {
  const Eigen::Quaterniond truth(oval.pose(t_s).attitude);
  Vector9 e;
  e << oval.pose(t_s).at - as_vector(b.position_m),
      log_rotation(truth * quaternion_of(b).conjugate()),
      oval.velocity(t_s) - as_vector(b.velocity_mps);
  return e;
}

struct Sums {
  double all = 0.0, place = 0.0, attitude = 0.0, velocity = 0.0;
};

void add(const Vector9& e, const SpatialBelief& b, Sums& sums) {
  const Eigen::Matrix<double, 9, 9> c =
      Eigen::Map<const ErrorMatrix>(b.covariance.data()).topLeftCorner<9, 9>();
  const auto part = [&](int at) {
    const Eigen::Vector3d x = e.segment<3>(at);
    const Eigen::Matrix3d inverse = c.block<3, 3>(at, at).inverse();
    return x.dot(inverse * x);
  };
  const Eigen::Matrix<double, 9, 9> inverse = c.inverse();
  sums.all += e.dot(inverse * e);
  sums.place += part(0), sums.attitude += part(3), sums.velocity += part(6);
}

// Sums over the seeds, one per instant.
std::vector<Sums> sums_over_seeds() {
  const Oval oval;
  const FilterParams p = testing::recommended_filter();
  std::vector<Sums> sums;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    OvalDrive drive(oval, static_cast<std::uint64_t>(seed));
    const auto all = drive.run(kDrive_s);
    auto state = std::make_unique<FilterState>();
    start(*state, p, drive.seed());
    std::size_t next = 0, row = 0;
    for (std::int64_t ms = kFrom_ms; ms < static_cast<std::int64_t>(kDrive_s * 1e3);
         ms += kEvery_ms) {
      for (; next < all.size() && all[next].at_ms <= ms; ++next)
        (void)insert(*state, p, all[next].measurement);
      const Instant now{ms * 1'000'000};
      (void)estimate_at(*state, p, now);
      SpatialBelief b = state->spatial.tip;
      advance(b, p.spatial, now, nullptr);
      if (sums.size() == row) sums.emplace_back();
      add(error_of(oval, b, (now - Instant{}).seconds()), b, sums[row++]);
    }
  }
  return sums;
}

// Chi-square of 180 degrees of freedom: 95 % lie in 144.7 to 219.0; of 60 in 40.5 to 83.3. The
// instants of one drive are correlated, the drives are not.
TEST(FilterConsistency, ErrorsAreWithinTheBoundsOfTheirCovariance) {
  const auto sums = sums_over_seeds();
  ASSERT_EQ(sums.size(), 5u);
  int outside = 0;
  for (const Sums& s : sums) {
    outside += s.all < 144.7 || s.all > 219.0;
    EXPECT_LT(s.place, 95.0) << s.place / 60.0;  // 99.7 %
    EXPECT_LT(s.attitude, 95.0) << s.attitude / 60.0;
    EXPECT_LT(s.velocity, 95.0) << s.velocity / 60.0;
  }
  EXPECT_LE(outside, 1);
}

}  // namespace
}  // namespace pitwall::localization
