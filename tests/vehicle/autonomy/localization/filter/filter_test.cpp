// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/autonomy/localization/oval.hpp"

namespace pitwall::localization {
namespace {

using testing::Arrival;
using testing::Oval;
using testing::OvalDrive;
using testing::recommended_filter;

constexpr FilterKind kBothKinds[] = {FilterKind::kPlanar, FilterKind::kSpatial};

std::unique_ptr<FilterState> started(const FilterParams& p, const Seed& seed) {
  auto state = std::make_unique<FilterState>();
  start(*state, p, seed);
  return state;
}

// Mixes what arrives within a fifth of a second.
void mix(std::vector<Arrival>& all, std::uint64_t seed) {
  Random random{seed};
  for (Arrival& a : all)
    a.at_ms = a.measurement.at.ns / 1'000'000 + static_cast<std::int64_t>(200.0 * random.uniform());
  std::stable_sort(all.begin(), all.end(),
                   [](const Arrival& a, const Arrival& b) { return a.at_ms < b.at_ms; });
}

TEST(Filter, OrderOfArrivalDoesNotMatter) {
  for (const FilterKind kind : kBothKinds) {
    const FilterParams p = recommended_filter(kind);
    OvalDrive drive(Oval{}, 3);
    const Seed seed = drive.seed();
    auto in_order = drive.run(5.0);
    std::stable_sort(in_order.begin(), in_order.end(), [](const Arrival& a, const Arrival& b) {
      return a.measurement.at < b.measurement.at;
    });
    auto straight = started(p, seed);
    for (const Arrival& a : in_order) ASSERT_TRUE(insert(*straight, p, a.measurement));
    const Instant now = newest(*straight);
    const Estimate expected = estimate_at(*straight, p, now);
    for (std::uint64_t order = 1; order <= 10; ++order) {
      auto mixed = in_order;
      mix(mixed, order);
      auto state = started(p, seed);
      for (const Arrival& a : mixed) ASSERT_TRUE(insert(*state, p, a.measurement));
      const Estimate e = estimate_at(*state, p, now);
      for (std::size_t i = 0; i < 25; ++i)
        ASSERT_NEAR(e.covariance[i], expected.covariance[i], 1e-9);
      ASSERT_NEAR(e.position_m[0], expected.position_m[0], 1e-9) << order;
      ASSERT_NEAR(e.position_m[1], expected.position_m[1], 1e-9) << order;
      ASSERT_NEAR(e.yaw_rad, expected.yaw_rad, 1e-9);
      ASSERT_NEAR(e.velocity_mps[0], expected.velocity_mps[0], 1e-9);
      ASSERT_NEAR(e.gyro_bias_rad_per_s[2], expected.gyro_bias_rad_per_s[2], 1e-9);
    }
  }
}

// The same drive on a map that is turned and moved gives the same estimates, turned and moved.
TEST(Filter, TheMapMayLieAnyWay) {
  const FilterParams p = recommended_filter();
  const double turned = 2.1;
  Oval plain, other;
  other.turned_rad = turned, other.east_m = 300.0, other.north_m = -150.0;
  // Noise is drawn along the axes of the map, so there is none; models see what they see.
  testing::OvalSensors quiet;
  quiet.wander_share = 0.0, quiet.position_m = quiet.height_m = 1e-9;
  quiet.velocity_mps = quiet.vertical_mps = 0.0;
  const auto at_end = [&](const Oval& oval) {
    OvalDrive drive(oval, 9, quiet);
    auto all = drive.run(6.0);
    Seed seed = drive.seed();
    seed.antenna_sigma_m = 0.01;
    auto state = started(p, seed);
    for (Arrival& a : all) {
      if (a.measurement.kind == Kind::kPosition)
        a.measurement.sigma_a = a.measurement.sigma_b = a.measurement.sigma_c = 0.01;
      EXPECT_TRUE(insert(*state, p, a.measurement));
    }
    return estimate_at(*state, p, Instant{} + seconds(6));
  };
  const Estimate a = at_end(plain), b = at_end(other);
  const double c = std::cos(turned), s = std::sin(turned);
  EXPECT_NEAR(b.position_m[0], 300.0 + c * a.position_m[0] - s * a.position_m[1], 1e-5);
  EXPECT_NEAR(b.position_m[1], -150.0 + s * a.position_m[0] + c * a.position_m[1], 1e-5);
  EXPECT_NEAR(b.position_m[2], a.position_m[2], 1e-5);
  EXPECT_NEAR(wrap_pi(b.yaw_rad - a.yaw_rad - turned), 0.0, 1e-6);
  EXPECT_NEAR(b.roll_rad, a.roll_rad, 1e-6);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(b.velocity_mps[i], a.velocity_mps[i], 1e-5);
  EXPECT_NEAR(b.position_sigma_m, a.position_sigma_m, 1e-7);
}

// Delivered as the sensors deliver it, judged every 10 ms; err is called with the truth.
template <class Each>
void follow(OvalDrive& drive, const FilterParams& p, double for_s, Each each) {
  const auto all = drive.run(for_s);
  auto state = started(p, drive.seed());
  std::size_t next = 0;
  for (std::int64_t ms = 10; ms < static_cast<std::int64_t>(for_s * 1000.0); ms += 10) {
    for (; next < all.size() && all[next].at_ms <= ms; ++next)
      ASSERT_TRUE(insert(*state, p, all[next].measurement));
    each(static_cast<double>(ms) * 1e-3, publish(*state, p, Instant{ms * 1'000'000}));
  }
}

double off_m(const Oval& oval, double t_s, const Estimate& e) {
  const Eigen::Vector3d truth = oval.pose(t_s).at;
  return std::hypot(e.position_m[0] - truth.x(), e.position_m[1] - truth.y());
}

TEST(Filter, SpatialKnowsPlaceHeadingAndSpeedInTheBank) {
  const Oval oval;
  OvalDrive drive(oval, 4);
  double place2 = 0.0, yaw2 = 0.0, speed2 = 0.0;
  int n = 0;
  follow(drive, recommended_filter(), 25.0, [&](double t, const Estimate& e) {
    if (t < 8.0) return;
    const testing::Pose truth = oval.pose(t);
    const double yaw = std::atan2(truth.attitude(1, 0), truth.attitude(0, 0));
    place2 += std::pow(off_m(oval, t, e), 2);
    yaw2 += std::pow(wrap_pi(e.yaw_rad - yaw), 2);
    speed2 += std::pow(e.velocity_mps[0] - oval.forward_mps(t), 2);
    EXPECT_NEAR(e.position_m[2], truth.at.z(), 0.1);
    ++n;
  });
  EXPECT_LT(std::sqrt(place2 / n), 0.03);
  EXPECT_LT(std::sqrt(yaw2 / n), from_deg(0.1));
  EXPECT_LT(std::sqrt(speed2 / n), 0.05);
}

TEST(Filter, SpatialReckonsThroughAnOutageAndReturnsSmoothly) {
  const Oval oval;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    OvalDrive drive(oval, seed);
    drive.silent[0] = drive.silent[1] = {20.0, 25.0};
    Estimate last;
    follow(drive, recommended_filter(), 28.0, [&](double t, const Estimate& e) {
      if (t > 19.9 && t < 22.0) {
        EXPECT_LT(off_m(oval, t, e), 0.5) << t;
      }
      if (t > 22.0 && t < 25.0) {
        EXPECT_LT(off_m(oval, t, e), 1.5) << t;
      }
      if (t > 27.5) {
        EXPECT_LT(off_m(oval, t, e), 0.05) << t;
      }
      if (t > 20.0) {  // what a tick adds beyond the motion
        const Eigen::Vector3d way = oval.path(t) - oval.path(t - 0.01);
        const double step = std::hypot(e.position_m[0] - last.position_m[0] - way.x(),
                                       e.position_m[1] - last.position_m[1] - way.y());
        EXPECT_LT(step, 0.05) << t;
      }
      last = e;
    });
  }
}

TEST(Filter, SpatialKeepsAStepOfOneReceiverOut) {
  const Oval oval;
  for (const std::size_t unit : {0u, 1u}) {
    OvalDrive drive(oval, 6 + unit);
    drive.stepped[unit] = {12.0, 18.0};
    follow(drive, recommended_filter(), 20.0, [&](double t, const Estimate& e) {
      if (t > 11.0) {
        EXPECT_LT(off_m(oval, t, e), 0.10) << unit << " " << t;
      }
    });
  }
}

// A correction of one metre is handed out by the limit, and said to be missing while it is.
TEST(Filter, PublishedPositionMovesByItsLimit) {
  FilterParams p = recommended_filter();
  auto state = started(p, {.antenna_m = {0.0, 0.0, 0.28},
                           .antenna_sigma_m = 0.5,
                           .yaw_rad = 0.0,
                           .yaw_sigma_rad = 0.01});
  const Estimate before = publish(*state, p, Instant{} + milliseconds(10));
  ASSERT_TRUE(insert(*state, p,
                     {.kind = Kind::kPosition,
                      .at = Instant{} + milliseconds(15),
                      .a = 1.0,
                      .b = 0.0,
                      .sigma_a = 0.01,
                      .sigma_b = 0.01})
                  ->accepted);
  Estimate last = before;
  for (std::int64_t ms = 20; ms < 1000; ms += 10) {
    const Estimate e = publish(*state, p, Instant{ms * 1'000'000});
    const double moved =
        std::hypot(e.position_m[0] - last.position_m[0], e.position_m[1] - last.position_m[1]);
    ASSERT_LT(moved, 0.011 * p.reentry_mps + 0.005) << ms;
    ASSERT_GE(e.position_sigma_m, e.correction_left_m);
    if (ms < 300) {
      ASSERT_GT(e.correction_left_m, 0.1);
    }
    last = e;
  }
  EXPECT_EQ(last.correction_left_m, 0.0);
  EXPECT_NEAR(last.position_m[0], estimate_at(*state, p, last.at).position_m[0], 1e-12);
}

TEST(Filter, StartsWhereTheSeedSays) {
  Oval oval;
  OvalDrive drive(oval, 2);
  const Seed seed = drive.seed();
  const testing::Pose truth = oval.pose(0.0);
  for (const FilterKind kind : kBothKinds) {
    const FilterParams p = recommended_filter(kind);
    auto state = started(p, seed);
    const Estimate e = estimate_at(*state, p, seed.at);
    EXPECT_LT(off_m(oval, 0.0, e), 0.05);
    EXPECT_LT(off_m(oval, 0.0, e), 4.0 * e.position_sigma_m);
    EXPECT_EQ(std::isfinite(e.roll_rad), kind == FilterKind::kSpatial);
    EXPECT_EQ(newest(*state), seed.at);
    if (kind == FilterKind::kPlanar) continue;
    EXPECT_NEAR(e.position_m[2], truth.at.z(), 0.1);
    EXPECT_NEAR(e.roll_rad, std::atan2(truth.attitude(2, 1), truth.attitude(2, 2)), 0.02);
  }
}

TEST(Filter, TooOldIsNothing) {
  for (const FilterKind kind : kBothKinds) {
    const FilterParams p = recommended_filter(kind);
    OvalDrive drive(Oval{}, 2);
    Seed seed = drive.seed();
    seed.at = Instant{} + seconds(1);
    auto state = started(p, seed);
    EXPECT_FALSE(insert(*state, p, {.kind = Kind::kSlip, .at = Instant{} + milliseconds(999)}));
    EXPECT_TRUE(insert(*state, p, {.kind = Kind::kSlip, .at = Instant{} + milliseconds(1001)}));
  }
}

TEST(Filter, TakesNothingFromTheHeap) {
  if (!pitwall::testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer has its own heap";
  for (const FilterKind kind : kBothKinds) {
    const FilterParams p = recommended_filter(kind);
    OvalDrive drive(Oval{}, 2);
    const auto all = drive.run(2.0);
    auto state = started(p, drive.seed());
    const auto run = [&] {
      for (const Arrival& a : all) (void)insert(*state, p, a.measurement);
      (void)publish(*state, p, newest(*state));
    };
    EXPECT_EQ(pitwall::testing::allocations_of(run), 0u);
  }
}

}  // namespace
}  // namespace pitwall::localization
