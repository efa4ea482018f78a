// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/admission.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <vector>

#include "tests/vehicle/autonomy/tracking/race.hpp"

namespace pitwall::tracking {
namespace {

using testing::Car;
using testing::ego_of;
using testing::seen;
using world::Detection;
using world::DetectionFrame;
using world::DetectionSource;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
const Car kOwn{.s_m = 100.0, .n_m = -3.0, .speed_mps = 60.0};

// At 2 s, after two seconds of ticks.
struct Gate {
  OwnTrail trail;
  Params params;
  Counters counters;
  const world::TrackMap* track = &testing::round_track();
  world::SensorUse use;

  Gate() {
    for (int k = 0; k <= 200; ++k)
      trail.note(ego_of(kOwn.at(0.01 * k), at_ms(10 * k)), &testing::round_track());
  }
  std::optional<AdmittedFrame> admit(const DetectionFrame& f) {
    return tracking::admit(params, {.own = trail, .track = track, .use = use, .now = at_ms(2000)},
                           f, counters);
  }
  // Number of detections that are used.
  std::size_t used(DetectionSource source, const Detection& d) {
    DetectionFrame f{.source = source, .at = at_ms(1950)};
    (void)f.detections.push(d);
    const auto admitted = admit(f);
    return admitted ? admitted->measurements.size() : 99;
  }
};

Detection ahead(DetectionSource source, double ahead_m = 40.0, double n_m = 2.0) {
  const Car car{.s_m = kOwn.s_m + ahead_m, .n_m = n_m, .speed_mps = 60.0};
  return seen(source, kOwn.at(1.95), car.at(1.95));
}

TEST(Admission, PassesWhatIsGood) {
  for (const auto source :
       {DetectionSource::kLidar, DetectionSource::kCamera, DetectionSource::kRadar}) {
    Gate gate;
    EXPECT_EQ(gate.used(source, ahead(source)), 1U);
    EXPECT_EQ(gate.used(source, ahead(source, -30.0)), 1U);
    EXPECT_EQ(gate.used(source, ahead(source, 290.0)), 1U) << "round the bend";
    EXPECT_EQ(gate.counters.frames, 3U);
    EXPECT_EQ(gate.counters.detections, 3U);
  }
}

TEST(Admission, PlacesTheFrameByItsOwnTime) {
  Gate gate;
  const auto admitted = gate.admit({.at = at_ms(1234)});
  ASSERT_TRUE(admitted);
  EXPECT_NEAR(admitted->own.x_m, kOwn.at(1.234).x_m, 1e-3);
  EXPECT_TRUE(admitted->measurements.empty());
}

TEST(Admission, ValuesThatASensorDoesNotMeasureMayBeUnset) {
  Gate gate;
  Detection d = ahead(DetectionSource::kLidar);
  d.yaw_rad = d.length_m = d.width_m = kUnset;
  EXPECT_EQ(gate.used(DetectionSource::kLidar, d), 1U);
  d = ahead(DetectionSource::kCamera);
  d.inverse_depth_per_m = kUnset;
  EXPECT_EQ(gate.used(DetectionSource::kCamera, d), 1U);
  d = ahead(DetectionSource::kRadar);
  d.range_rate_mps = kUnset;
  EXPECT_EQ(gate.used(DetectionSource::kRadar, d), 1U);
}

TEST(Admission, RefusesValuesThatAreNone) {
  Gate gate;
  std::uint64_t refused = 0;
  const auto refuse = [&](DetectionSource source, double Detection::*value, double v) {
    Detection d = ahead(source);
    d.*value = v;
    EXPECT_EQ(gate.used(source, d), 0U);
    EXPECT_EQ(gate.counters.not_finite, ++refused);
  };
  for (const double v : {kUnset, kInfinite, -kInfinite, 1e300}) {
    refuse(DetectionSource::kLidar, &Detection::x_m, v);
    refuse(DetectionSource::kLidar, &Detection::y_m, v);
    refuse(DetectionSource::kCamera, &Detection::bearing_rad, v);
    refuse(DetectionSource::kRadar, &Detection::range_m, v);
    refuse(DetectionSource::kRadar, &Detection::bearing_rad, v);
    refuse(DetectionSource::kLidar, &Detection::confidence, v);
  }
  for (const double v : {kInfinite, 1e300}) {
    refuse(DetectionSource::kLidar, &Detection::yaw_rad, v);
    refuse(DetectionSource::kLidar, &Detection::length_m, v);
    refuse(DetectionSource::kLidar, &Detection::width_m, v);
    refuse(DetectionSource::kCamera, &Detection::inverse_depth_per_m, v);
    refuse(DetectionSource::kRadar, &Detection::range_rate_mps, v);
  }
  for (const double v : {0.0, -5.0}) {
    refuse(DetectionSource::kRadar, &Detection::range_m, v);
    refuse(DetectionSource::kCamera, &Detection::inverse_depth_per_m, v);
  }
  EXPECT_EQ(gate.counters.detections, 0U);
}

TEST(Admission, RefusesDetectionsByTheirPlace) {
  Gate gate;
  EXPECT_EQ(gate.used(DetectionSource::kLidar, ahead(DetectionSource::kLidar, 400.0)), 0U);
  EXPECT_EQ(gate.counters.too_far, 1U);
  EXPECT_EQ(gate.used(DetectionSource::kLidar, {.confidence = 0.9, .x_m = 2.0, .y_m = -0.5}), 0U);
  EXPECT_EQ(gate.counters.in_own_car, 1U);
  EXPECT_EQ(gate.used(DetectionSource::kLidar, {.confidence = 0.9, .x_m = 0.0, .y_m = 1.9}), 1U)
      << "beside us";
  for (const double n_m : {12.0, -12.0})
    EXPECT_EQ(gate.used(DetectionSource::kLidar, ahead(DetectionSource::kLidar, 40.0, n_m)), 0U);
  EXPECT_EQ(gate.counters.off_track, 2U);
  for (const double n_m : {10.5, -10.5})  // within the margin
    EXPECT_EQ(gate.used(DetectionSource::kLidar, ahead(DetectionSource::kLidar, 40.0, n_m)), 1U);
  gate.track = nullptr;
  EXPECT_EQ(gate.used(DetectionSource::kLidar, ahead(DetectionSource::kLidar, 40.0, 12.0)), 1U);
}

TEST(Admission, RefusesLowConfidence) {
  Gate gate;
  Detection d = ahead(DetectionSource::kLidar);
  d.confidence = 0.29;
  EXPECT_EQ(gate.used(DetectionSource::kLidar, d), 0U);
  EXPECT_EQ(gate.counters.low_confidence, 1U);
  d.confidence = 0.3;
  EXPECT_EQ(gate.used(DetectionSource::kLidar, d), 1U);
}

TEST(Admission, RefusesFramesByTheirTime) {
  Gate gate;
  EXPECT_TRUE(gate.admit({.at = at_ms(1000)}));
  EXPECT_FALSE(gate.admit({.at = at_ms(1000) - nanoseconds(1)}));
  EXPECT_FALSE(gate.admit({.at = Instant{INT64_MIN}}));
  EXPECT_EQ(gate.counters.frames_too_old, 2U);
  EXPECT_TRUE(gate.admit({.at = at_ms(2005)}));
  EXPECT_FALSE(gate.admit({.at = at_ms(2006)}));
  EXPECT_FALSE(gate.admit({.at = Instant::max()}));
  EXPECT_EQ(gate.counters.frames_in_future, 2U);
  gate.trail = OwnTrail{};
  EXPECT_FALSE(gate.admit({.at = at_ms(1950)}));
  EXPECT_EQ(gate.counters.frames_unplaced, 1U);
  EXPECT_EQ(gate.counters.frames, 2U);
}

TEST(Admission, RefusesSourcesThatItDoesNotKnow) {
  Gate gate;
  EXPECT_FALSE(gate.admit({.source = static_cast<DetectionSource>(3), .at = at_ms(1950)}));
  EXPECT_EQ(gate.counters.frames_unknown, 1U);
  gate.params.method = Method::kPaper;
  EXPECT_FALSE(gate.admit({.source = DetectionSource::kRadar, .at = at_ms(1950)}));
  EXPECT_TRUE(gate.admit({.source = DetectionSource::kCamera, .at = at_ms(1950)}));
  EXPECT_EQ(gate.counters.frames_unknown, 2U);
}

TEST(Admission, RefusesASensorThatTheOperatorHasExcluded) {
  using enum world::Excludable;
  struct Sensor {
    DetectionSource source;
    std::uint8_t unit;
  };
  const std::array sensors{Sensor{DetectionSource::kLidar, 0},  Sensor{DetectionSource::kLidar, 2},
                           Sensor{DetectionSource::kCamera, 0}, Sensor{DetectionSource::kCamera, 1},
                           Sensor{DetectionSource::kCamera, 2}, Sensor{DetectionSource::kRadar, 0}};
  const std::map<world::Excludable, std::vector<std::size_t>> excluded{
      {kGnss0, {}},     {kGnss1, {}},    {kImu0, {}},     {kImu1, {}},  {kWheels, {}},
      {kLidar, {0, 1}}, {kCamera0, {2}}, {kCamera1, {3}}, {kRadar, {5}}};
  ASSERT_EQ(excluded.size(), world::kExcludables);
  for (const auto& [sensor, of_those] : excluded) {
    Gate gate;
    gate.use.excluded = static_cast<std::uint16_t>(1U << static_cast<unsigned>(sensor));
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      const bool is_out = std::ranges::find(of_those, i) != of_those.end();
      const auto [source, unit] = sensors[i];
      EXPECT_EQ(gate.admit({.source = source, .unit = unit, .at = at_ms(1950)}).has_value(),
                !is_out)
          << static_cast<int>(sensor) << " " << i;
    }
    EXPECT_EQ(gate.counters.frames_excluded, of_those.size());
    EXPECT_EQ(gate.counters.frames, sensors.size() - of_those.size());
  }
}

}  // namespace
}  // namespace pitwall::tracking
