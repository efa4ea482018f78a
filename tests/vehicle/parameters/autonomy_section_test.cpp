// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/vocabulary/units.hpp"
#include "tests/vehicle/parameters/mutation.hpp"
#include "vehicle/parameters/car_file.hpp"

namespace pitwall::parameters {
namespace {

using pipeline::CarParams;
using testing::av21;
using testing::refusal;
using testing::Reported;
using testing::with;

Reported localization(const CarParams& p) {
  Reported reported{
      {"localization.units[0].antenna_m[0]", p.localization.units[0].antenna.x_m},
      {"localization.units[0].antenna_m[1]", p.localization.units[0].antenna.y_m},
      {"localization.units[0].antenna_m[2]", p.localization.units[0].antenna.z_m},
      {"localization.units[0].baseline_yaw_deg", to_deg(p.localization.units[0].baseline_yaw_rad)},
      {"localization.units[0].baseline_m", p.localization.units[0].baseline_m},
      {"localization.units[0].imu_m[0]", p.localization.units[0].imu.x_m},
      {"localization.units[0].imu_m[1]", p.localization.units[0].imu.y_m},
      {"localization.units[0].imu_m[2]", p.localization.units[0].imu.z_m},
      {"localization.units[1].antenna_m[0]", p.localization.units[1].antenna.x_m},
      {"localization.units[1].antenna_m[1]", p.localization.units[1].antenna.y_m},
      {"localization.units[1].antenna_m[2]", p.localization.units[1].antenna.z_m},
      {"localization.units[1].baseline_yaw_deg", to_deg(p.localization.units[1].baseline_yaw_rad)},
      {"localization.units[1].baseline_m", p.localization.units[1].baseline_m},
      {"localization.units[1].imu_m[0]", p.localization.units[1].imu.x_m},
      {"localization.units[1].imu_m[1]", p.localization.units[1].imu.y_m},
      {"localization.units[1].imu_m[2]", p.localization.units[1].imu.z_m},
      {"localization.position_sigma_max_m", p.localization.position_sigma_max_m},
      {"localization.heading_sigma_max_rad", p.localization.heading_sigma_max_rad},
      {"localization.filter.window_s", p.localization.filter.window_s},
      {"localization.filter.reentry_mps", p.localization.filter.reentry_mps},
      {"localization.imu_timeout_s", p.localization.imu_timeout_s},
      {"localization.good_age_max_s", p.localization.good_age_max_s},
      {"localization.dead_reckoning_max_s", p.localization.dead_reckoning_max_s},
      {"localization.good_sigma_max_m", p.localization.good_sigma_max_m},
      {"localization.lost_sigma_max_m", p.localization.lost_sigma_max_m},
      {"localization.reset_after_s", p.localization.reset_after_s},
  };
  const localization::FilterParams& filter = p.localization.filter;
  const std::string planar = "localization.filter.planar.",
                    spatial = "localization.filter.spatial.";
  for (const auto& r : localization::kMotionNoiseRanges)
    reported[planar + r.name] = filter.planar.noise.*r.value;
  for (const auto& r : localization::kPlanarRanges)
    reported[planar + r.name] = filter.planar.*r.value;
  for (const auto& r : localization::kSpatialRanges)
    reported[spatial + r.name] = filter.spatial.*r.value;
  for (std::size_t i = 0; i < 2; ++i)
    reported[planar + "gate_nis[" + std::to_string(i) + "]"] = filter.planar.gate_nis[i];
  for (std::size_t i = 0; i < 3; ++i)
    reported[spatial + "gate_nis[" + std::to_string(i) + "]"] = filter.spatial.gate_nis[i];
  return reported;
}

Reported engine(const envelope::Engine& e) {
  const std::string section = "planning.line.friction.engine.";
  Reported reported;
  for (const auto& r : envelope::kEngineRanges) reported[section + r.name] = e.*r.value;
  for (std::size_t i = 0; i < e.rpm.size(); ++i) {
    reported[section + "rpm[" + std::to_string(i) + "]"] = e.rpm[i];
    reported[section + "torque_nm[" + std::to_string(i) + "]"] = e.torque_nm[i];
  }
  for (std::size_t i = 0; i < e.part_throttle.size(); ++i) {
    const std::string row = section + "part_throttle[" + std::to_string(i) + "].";
    reported[row + "throttle"] = e.part_throttle[i].throttle;
    for (std::size_t k = 0; k < e.rpm.size(); ++k)
      reported[row + "share[" + std::to_string(k) + "]"] = e.part_throttle[i].share[k];
  }
  for (std::size_t i = 0; i < e.ratio.size(); ++i)
    reported[section + "ratio[" + std::to_string(i) + "]"] = e.ratio[i];
  return reported;
}

Reported planning(const CarParams& p) {
  Reported reported{
      {"planning.line.offset_m", p.planning.line.offset_m},
      {"planning.line.wall_clearance_m", p.planning.line.wall_clearance_m},
      {"planning.line.spacing_m", p.planning.line.spacing_m},
      {"planning.line.speed_max_mps", p.planning.line.speed_max_mps},
      {"planning.line.grip_share", p.planning.line.grip_share},
      {"planning.line.friction.friction", p.planning.line.friction.friction},
      {"planning.line.friction.downforce_per_m", p.planning.line.friction.downforce_per_m},
      {"planning.line.friction.drag_per_m", p.planning.line.friction.drag_per_m},
      {"planning.line.friction.accel_max_mps2", p.planning.line.friction.accel_max_mps2},
      {"planning.line.friction.power_w_per_kg", p.planning.line.friction.power_w_per_kg},
      {"planning.line.friction.brake_max_mps2", p.planning.line.friction.brake_max_mps2},
      {"planning.line.friction.brake_front", p.planning.line.friction.brake_front},
      {"planning.line.friction.load_front", p.planning.line.friction.load_front},
      {"planning.line.friction.load_shift", p.planning.line.friction.load_shift},
      {"planning.line.friction.long_friction", p.planning.line.friction.long_friction},
      {"planning.line.friction.tyres.temperature_c[0]",
       p.planning.line.friction.tyres.temperature_c[0]},
      {"planning.line.friction.tyres.share[0]", p.planning.line.friction.tyres.share[0]},
      {"planning.line.friction.tyres.temperature_c[1]",
       p.planning.line.friction.tyres.temperature_c[1]},
      {"planning.line.friction.tyres.share[1]", p.planning.line.friction.tyres.share[1]},
      {"planning.line.friction.tyres.temperature_c[2]",
       p.planning.line.friction.tyres.temperature_c[2]},
      {"planning.line.friction.tyres.share[2]", p.planning.line.friction.tyres.share[2]},
      {"planning.line.friction.tyres.temperature_c[3]",
       p.planning.line.friction.tyres.temperature_c[3]},
      {"planning.line.friction.tyres.share[3]", p.planning.line.friction.tyres.share[3]},
      {"planning.stop.clearance_m", p.planning.stop_path.clearance_m},
      {"planning.stop.low_speed_mps", p.planning.stop_path.low_speed_mps},
      {"planning.stop.stretch_max", p.planning.stop_path.stretch_max},
      {"planning.stop.emergency_decel_max_mps2", p.planning.emergency_decel_max_mps2},
      {"planning.stop.emergency_jerk_max_mps3", p.planning.emergency_jerk_max_mps3},
      {"planning.stop.emergency_grip_share", p.planning.emergency_grip_share},
      {"planning.green_speed_mps", p.planning.green_speed_mps},
      {"planning.caution_speed_mps", p.planning.caution_speed_mps},
      {"planning.accel_max_mps2", p.planning.comfort.accel_max_mps2},
      {"planning.decel_max_mps2", p.planning.comfort.decel_max_mps2},
      {"planning.jerk_max_mps3", p.planning.comfort.jerk_max_mps3},
      {"planning.speed_band_mps", p.planning.speed_band_mps},
      {"planning.stop_decel_max_mps2", p.planning.stop_decel_max_mps2},
      {"planning.stop_jerk_max_mps3", p.planning.stop_jerk_max_mps3},
      {"planning.stop_grip_share", p.planning.stop_grip_share},
      {"planning.point_spacing_m", p.planning.point_spacing_m},
      {"planning.steer_share", p.planning.steer_share},
      {"planning.merge_from_m", p.planning.merge_from_m},
      {"planning.merge_time_s", p.planning.merge_time_s},
      {"planning.merge_least_m", p.planning.merge_least_m},
  };
  reported.merge(engine(p.planning.line.friction.engine));
  return reported;
}

Reported control(const CarParams& p) {
  Reported reported{
      {"control.lateral.lookahead_base_m", p.control.lateral.lookahead_base_m},
      {"control.lateral.lookahead_per_speed_s", p.control.lateral.lookahead_per_speed_s},
      {"control.lateral.angle_max_rad", p.control.lateral.angle_max_rad},
      {"control.lateral.gain_speed_floor_mps", p.control.lateral.gain_speed_floor_mps},
      {"control.lateral.deviation_max_m", p.control.lateral.deviation_max_m},
      {"control.longitudinal.kp_per_mps", p.control.longitudinal.kp_per_mps},
      {"control.longitudinal.feedforward_per_mps", p.control.longitudinal.feedforward_per_mps},
      {"control.longitudinal.brake_kpa_per_command", p.control.longitudinal.brake_kpa_per_command},
      {"control.longitudinal.speed_preview_s", p.control.longitudinal.speed_preview_s},
      {"control.longitudinal.throttle_max", p.control.longitudinal.throttle_max},
      {"control.longitudinal.throttle_rise_per_s", p.control.longitudinal.throttle_rise_per_s},
      {"control.longitudinal.throttle_fall_per_s", p.control.longitudinal.throttle_fall_per_s},
      {"control.longitudinal.brake_max_kpa", p.control.longitudinal.brake_max_kpa},
      {"control.longitudinal.brake_rise_kpa_per_s", p.control.longitudinal.brake_rise_kpa_per_s},
      {"control.longitudinal.brake_fall_kpa_per_s", p.control.longitudinal.brake_fall_kpa_per_s},
      {"control.longitudinal.hold_speed_mps", p.control.longitudinal.hold_speed_mps},
      {"control.longitudinal.hold_brake_kpa", p.control.longitudinal.hold_brake_kpa},
      {"control.gear.up_above_mps[0]", p.control.gear.up_above_mps[0]},
      {"control.gear.up_above_mps[1]", p.control.gear.up_above_mps[1]},
      {"control.gear.up_above_mps[2]", p.control.gear.up_above_mps[2]},
      {"control.gear.up_above_mps[3]", p.control.gear.up_above_mps[3]},
      {"control.gear.up_above_mps[4]", p.control.gear.up_above_mps[4]},
      {"control.gear.down_below_mps[0]", p.control.gear.down_below_mps[0]},
      {"control.gear.down_below_mps[1]", p.control.gear.down_below_mps[1]},
      {"control.gear.down_below_mps[2]", p.control.gear.down_below_mps[2]},
      {"control.gear.down_below_mps[3]", p.control.gear.down_below_mps[3]},
      {"control.gear.down_below_mps[4]", p.control.gear.down_below_mps[4]},
      {"control.gear.dwell_s", p.control.gear.dwell_s},
      {"control.gear.confirm_s", p.control.gear.confirm_s},
  };
  for (const auto& r : control::kSpeedLawRanges)
    reported["control.speed." + std::string(r.name)] = p.control.speed.*r.value;
  for (std::size_t i = 0; i < control::kSpeedBrackets; ++i) {
    const std::string bracket = "control.lateral.brackets[" + std::to_string(i) + "].";
    for (std::size_t k = 0; k < 4; ++k)
      reported[bracket + "q[" + std::to_string(k) + "]"] = p.control.lateral.weights[i].state[k];
    reported[bracket + "r"] = p.control.lateral.weights[i].steering;
  }
  for (const auto& r : control::kLqrRanges)
    reported["control.lqr_ff." + std::string(r.name)] = p.control.lqr_ff.*r.value;
  for (const auto& r : control::kLapRanges)
    reported["control.lap." + std::string(r.name)] = p.control.lap.*r.value;
  for (std::size_t i = 0; i < control::kLqrSpeeds; ++i)
    for (const auto& r : control::kLqrWeightRanges)
      reported["control.lqr_ff.weights[" + std::to_string(i) + "]." + r.name] =
          p.control.lqr_ff.weights[i].*r.value;
  return reported;
}

Reported steering(const steering::Params& p) {
  Reported reported;
  for (const auto& r : steering::kLearningRanges)
    reported["steering." + std::string(r.name)] = p.learning.*r.value;
  for (const auto& r : steering::kRanges) reported["steering." + std::string(r.name)] = p.*r.value;
  return reported;
}

// One section, known to all that steer along a path.
TEST(AutonomySection, EachNumberOfSteeringMovesItsOwnParameterWhereverItIsKnown) {
  const auto in_a_stop = [](const CarParams& p) {
    return steering(p.supervisor.safe_stop.steering);
  };
  const auto in_control = [](const CarParams& p) { return steering(p.control.steering); };
  testing::expect_each_number_to_move_its_own("steering", in_a_stop);
  testing::expect_each_number_to_move_its_own("steering", in_control);
}

// One section; mass, inertia and stiffnesses are the regulator's.
TEST(AutonomySection, EachNumberOfTheBicycleMovesItsOwnParameterWhereverItIsKnown) {
  using Known = const steering::Bicycle& (*)(const CarParams&);
  const std::vector<Known> known{[](const CarParams& p) -> auto& {return p.control.steering.bicycle;
}
, [](const CarParams& p) -> auto& { return p.supervisor.safe_stop.steering.bicycle; }
, [](const CarParams& p) -> auto& { return p.supervisor.faults.oversteer.bicycle; }
, [](const CarParams& p) -> auto& { return p.localization.bicycle; }
};  // namespace
for (const Known bicycle : known) {
  testing::expect_each_number_to_move_its_own("bicycle", [&](const CarParams& p) {
    Reported reported;
    for (const auto& r : steering::kBicycleRanges)
      reported["bicycle." + std::string(r.name)] = bicycle(p).*r.value;
    for (const auto& r : control::kBicycleRanges)
      reported["bicycle." + std::string(r.name)] = p.control.bicycle.*r.value;
    return reported;
  });
}
}  // namespace pitwall::parameters

TEST(AutonomySection, TheAxlesOfTheBicycleAreThoseOfTheRegulatorAndOfTheFilters) {
  const auto car = read_car(with(with(av21(), "wheelbase_m: 2.971", "wheelbase_m: 3.1"),
                                 "cg_to_rear_m: 1.247", "cg_to_rear_m: 1.3"),
                            "car.yaml");
  ASSERT_TRUE(car) << to_string(car.error());
  EXPECT_EQ(car->params.control.bicycle.cg_to_rear_m, 1.3);
  EXPECT_NEAR(car->params.control.bicycle.cg_to_front_m, 1.8, 1e-12);
  EXPECT_EQ(car->params.localization.filter.planar.cg_to_rear_m, 1.3);
  EXPECT_EQ(car->params.localization.filter.spatial.cg_to_rear_m, 1.3);
}

TEST(AutonomySection, EachNumberOfLocalizationMovesItsOwnParameter) {
  testing::expect_each_number_to_move_its_own("localization", localization);
}

TEST(AutonomySection, EachNumberOfPlanningMovesItsOwnParameter) {
  testing::expect_each_number_to_move_its_own("planning", planning);
}

TEST(AutonomySection, EachNumberOfControlMovesItsOwnParameter) {
  testing::expect_each_number_to_move_its_own("control", control);
}

TEST(AutonomySection, ALineIsThatOfABankOrLiesAtAnOffset) {
  const std::string offset = "    offset_m: 0.0\n";
  const auto line_of = [&](const std::string& keys) {
    const auto car = read_car(with(av21(), offset, keys), "car.yaml");
    return car ? car->params.planning.line : throw std::runtime_error(to_string(car.error()));
  };
  const planning::LineParams named = line_of("    bank: lines/a.json\n    name: inner/apex\n");
  EXPECT_EQ(named.bank, "lines/a.json");
  EXPECT_EQ(named.name, "inner/apex");
  EXPECT_EQ(line_of("    offset_m: 2.0\n").bank, "");
  const std::size_t line =
      1 +
      static_cast<std::size_t>(std::count(
          av21().begin(), av21().begin() + static_cast<std::ptrdiff_t>(av21().find(offset)), '\n'));
  struct Case {
    std::string keys;
    std::size_t below;  // line of the error, below that of the offset
    std::string word;
  };
  for (const Case& c : std::vector<Case>{
           {"    bank: a.json\n    name: x\n    offset_m: 0.0\n", 2, "a line of a bank is named"},
           {"    bank: a.json\n    offset_m: 0.0\n", 0, "name"},
           {"    bank: a.json\n", 0, "name"},
           {"    bank: \"\"\n    name: x\n", 0, "names no file"},
           {"    name: x\n    offset_m: 0.0\n", 0, "name"},
           {"", 0, "offset_m"}}) {
    const std::string why = refusal(with(av21(), offset, c.keys));
    EXPECT_EQ(why.rfind("car.yaml:" + std::to_string(line + c.below) + ":", 0), 0u) << why;
    EXPECT_NE(why.find(c.word), std::string::npos) << why;
  }
}

TEST(AutonomySection, ARacingPaceThatIsNotWrittenIsTheComfortableOne) {
  const planning::Params plain = read_car(av21(), "car.yaml")->params.planning;
  EXPECT_EQ(plain.racing.accel_max_mps2, plain.comfort.accel_max_mps2);
  EXPECT_EQ(plain.racing.decel_max_mps2, plain.comfort.decel_max_mps2);
  EXPECT_EQ(plain.racing.jerk_max_mps3, plain.comfort.jerk_max_mps3);
  const std::string racing = with(av21(), "  speed_band_mps: 4.0",
                                  "  racing: {accel_max_mps2: 6, decel_max_mps2: 8, "
                                  "jerk_max_mps3: 12}\n  speed_band_mps: 4.0");
  const planning::Params full = read_car(racing, "car.yaml")->params.planning;
  EXPECT_EQ(full.racing.accel_max_mps2, 6.0);
  EXPECT_EQ(full.racing.decel_max_mps2, 8.0);
  EXPECT_EQ(full.racing.jerk_max_mps3, 12.0);
  EXPECT_EQ(full.comfort.accel_max_mps2, plain.comfort.accel_max_mps2);
}

TEST(AutonomySection, PassingHasLinesBesideTheOwnOne) {
  EXPECT_FALSE(read_car(av21(), "car.yaml")->params.planning.passing);
  const auto passing = [](const std::string& lines, const std::string& law = "committed") {
    return read_car(
        with(av21(), "  speed_band_mps: 4.0",
             "  passing: {law: " + law + ", lines: [" + lines +
                 "], watch_ahead_m: 150, watch_behind_m: 80, forget_s: 3, "
                 "trail_gap_m: 25, complete_gap_m: 33, side_gap_m: 6, side_clear_m: 3.5, "
                 "trail_gain_per_s: 0.25, close_extra_mps: 4, pass_extra_mps: 8, "
                 "brake_mps2: 4, merge_time_s: 3.5, dwell_s: 0.5}\n"
                 "  speed_band_mps: 4.0"),
        "car.yaml");
  };
  const auto two = passing("{offset_m: -3}, {offset_m: 3.5}");
  ASSERT_TRUE(two);
  const planning::Passing& read = *two->params.planning.passing;
  EXPECT_EQ(read.lines.size(), 2u);
  EXPECT_EQ(read.lines[1].offset_m, 3.5);
  EXPECT_EQ(read.pass.rival.watch_behind_m, 80.0);
  EXPECT_EQ(read.pass.complete_gap_m, 33.0);
  EXPECT_EQ(passing("{offset_m: -3}", "paper")->params.planning.passing->pass.law,
            planning::PassLaw::kPaper);
  EXPECT_NE(to_string(passing("{offset_m: -3}", "bold").error()).find("committed, paper"),
            std::string::npos);
  EXPECT_FALSE(passing("{name: inner/apex}"));  // the own line has no bank
}

TEST(AutonomySection, BracketsBeginWhereTheControllerHasThem) {
  const std::string why = refusal(with(av21(), "from_mps: 25", "from_mps: 24"));
  EXPECT_NE(why.find("from_mps"), std::string::npos) << why;
  EXPECT_NE(why.find("25"), std::string::npos) << why;
}

TEST(AutonomySection, WeightsAreThoseOfTheSpeedsOfTheDesign) {
  const std::string why = refusal(with(av21(), "at_mps: 22", "at_mps: 23"));
  EXPECT_NE(why.find("at_mps"), std::string::npos) << why;
  EXPECT_NE(why.find("22"), std::string::npos) << why;
  const std::string row = "      - {at_mps: 22, turn: 0.02, angle: 1500.0}\n";
  for (const std::string& instead : {std::string{}, row + row}) {
    const std::string count = refusal(with(av21(), row, instead));
    EXPECT_NE(count.find("one entry per speed: 9"), std::string::npos) << count;
  }
}

TEST(AutonomySection, EveryUnitAndEveryBracketIsNeededOnce) {
  int rows = 0;
  for (const testing::Piece& line : testing::lines(av21())) {
    const bool unit = line.text.find("antenna_m") != std::string::npos;
    if (!unit && line.text.find("from_mps") == std::string::npos) continue;
    const std::string row = av21().substr(line.from, line.to - line.from);
    for (const std::string& instead : {std::string{}, row + row})
      EXPECT_NE(refusal(testing::replaced(av21(), line, instead)).find(unit ? "units" : "bracket"),
                std::string::npos)
          << line.text;
    ++rows;
  }
  EXPECT_EQ(rows, 2 + static_cast<int>(control::kSpeedBrackets));
}

TEST(AutonomySection, AControllerThatIsNoneAndTheOldKeyAreRefusedWithTheNamesOfNow) {
  EXPECT_EQ(read_car(av21(), "car.yaml")->params.control.controller.name, "lqr_ff");
  const std::string none = refusal(with(av21(), "controller: lqr_ff", "controller: pid"));
  EXPECT_NE(none.find("paper_lqr, feed_forward"), std::string::npos) << none;
  const std::string old =
      refusal(with(av21(), "    brackets:", "    drive_law: feed_forward\n    brackets:"));
  EXPECT_NE(old.find("control.controller"), std::string::npos) << old;
}

}  // namespace
}  // namespace pitwall::parameters
