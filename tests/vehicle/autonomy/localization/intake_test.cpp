// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/intake.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/vehicle/autonomy/localization/drive.hpp"

namespace pitwall::localization {
namespace {

using testing::banked_turn;
using testing::Rig;
using world::Monitor;

// What spoils a car so that one monitor sees it.
struct Trouble {
  Monitor monitor;
  void (*begin)(Rig& rig);
};

constexpr Trouble kTroubles[] = {
    {Monitor::kStreamAge, [](Rig& rig) { rig.sensors.imu_silent[0] = true; }},
    {Monitor::kSolution, [](Rig& rig) { rig.sensors.reported_sigma_factor[0] = 300.0; }},
    {Monitor::kInnovation, [](Rig& rig) { rig.sensors.east_m[0] = 0.5; }},
    {Monitor::kUnitAgreement, [](Rig& rig) { rig.sensors.gyro_bias_rad_per_s[0] = 0.2; }},
    {Monitor::kWheelAgreement, [](Rig& rig) { rig.sensors.wheel_factor[2] = 0.0; }}};

TEST(Intake, EachMonitorSeesItsTroubleAndOffItSeesNothing) {
  for (const Trouble& trouble : kTroubles) {
    for (const bool off : {false, true}) {
      auto rig = std::make_unique<Rig>();
      rig->course = banked_turn();
      if (off) rig->params.off.add(trouble.monitor);
      rig->run(6.0);
      ASSERT_TRUE(rig->out.seen.empty());
      trouble.begin(*rig);
      bool seen = false;
      for (int i = 0; i < 30; ++i) seen |= rig->tick().seen.has(trouble.monitor);
      EXPECT_EQ(seen, !off) << world::kMonitorNames[static_cast<std::size_t>(trouble.monitor)];
    }
  }
}

TEST(Intake, AMonitorThatIsOffLetsItsTroubleIn) {
  const auto error_with = [](Monitor off, auto begin) {
    auto rig = std::make_unique<Rig>();
    rig->course = banked_turn();
    rig->params.off.add(off);
    rig->run(6.0);
    begin(*rig);
    rig->run(1.0);
    return rig->position_error_m();
  };
  const auto gyro = [](Rig& rig) { rig.sensors.gyro_bias_rad_per_s[0] = 0.2; };
  EXPECT_GT(error_with(Monitor::kUnitAgreement, gyro), error_with(Monitor::kWheelAgreement, gyro));
}

TEST(Intake, EverySampleGetsOneVerdict) {
  auto rig = std::make_unique<Rig>();
  rig->course = banked_turn();
  for (int i = 0; i < 300; ++i) {
    rig->ms += 10;
    rig->turn_wheels();
    const world::SensorInput in = rig->arrivals();
    const std::size_t samples =
        in.positions.size() + in.velocities.size() + in.headings.size() + in.imu.size();
    EXPECT_EQ(rig->take(in).verdicts.size(), samples + 1) << "and one for the wheels";
  }
}

TEST(Intake, AFullInputHasRoomForItsVerdicts) {
  auto rig = std::make_unique<Rig>();
  rig->run(3.0);
  world::SensorInput in;
  while (in.imu.push(rig->imu(0, rig->ms))) {
  }
  while (in.positions.push(rig->position(0, rig->ms))) {
  }
  while (in.velocities.push(rig->velocity(0, rig->ms))) {
  }
  while (in.headings.push(rig->heading(0, rig->ms))) {
  }
  while (in.attitudes.push({})) {
  }
  rig->ms += 10;
  rig->turn_wheels();
  EXPECT_EQ(rig->take(in).verdicts.size(), in.imu.size() + in.positions.size() +
                                               in.velocities.size() + in.headings.size() +
                                               in.attitudes.size() + 1);
}

TEST(Intake, GapsAreKnownForEverySource) {
  for (std::size_t s = 0; s < kSources; ++s)
    EXPECT_GT(gap_max_s(CheckParams{}, static_cast<Source>(s)), 0.0) << s;
}

}  // namespace
}  // namespace pitwall::localization
