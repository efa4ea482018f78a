// SPDX-License-Identifier: Apache-2.0
// The AV-24's bus against that of the AV-21: every public difference, and no other.
#include "protocol/can/av24.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "protocol/can/av21.hpp"
#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

const std::filesystem::path kAv24Dbc = kSource / "protocol/can/dbc/av24.dbc";

// "start|length sign xscale" by name.
std::map<std::string, std::string> layout(const Message& message) {
  std::map<std::string, std::string> out;
  for (const Signal& s : message.signals) {
    char text[64];
    std::snprintf(text, sizeof text, "%u|%u%c x%g", unsigned{s.layout.start},
                  unsigned{s.layout.length}, s.layout.number == Number::kSigned ? '-' : '+',
                  s.layout.scale);
    out[s.name] = text;
  }
  return out;
}

using Layout = std::map<std::string, std::string>;

struct Delta {
  std::uint32_t id;
  unsigned length;
  Layout gone, come;  // signals against the AV-21
};

const Delta kDeltas[] = {
    {1303,
     8,
     {{"steering_motor_ang_avg_fdbk", "0|11- x0.5"}},
     {{"primary_steering_angular_rate", "0|16- x0.1"}, {"commanded_steering_rate", "24|16- x0.1"}}},
    {1304, 6, {}, {{"target_speed_multi_car_race", "40|8+ x1"}}},
    {1312,
     6,
     {{"steering_motor_ang_1_fdbk", "0|11- x0.5"},
      {"steering_motor_ang_2_fdbk", "16|11- x0.5"},
      {"steering_motor_ang_3_fdbk", "32|11- x0.5"}},
     {{"primary_steering_angle_fbk", "0|11- x0.5"},
      {"secondary_steering_ang_fdbk", "16|11- x0.5"},
      {"average_steering_ang_fdbk", "32|11- x0.5"}}},
    {1343,
     8,
     {},
     {{"push2pass_status", "40|4+ x1"},
      {"push2pass_budget_s", "44|10+ x1"},
      {"push2pass_active_app_limit", "54|7+ x1"}}},
    {1400,
     8,
     {{"brake_pressure_cmd", "0|13+ x1"}, {"brk_pressure_cmd_counter", "16|8+ x1"}},
     {{"F_brake_pressure_cmd", "0|13+ x1"},
      {"R_brake_pressure_cmd", "16|13+ x1"},
      {"brk_pressure_cmd_counter", "40|8+ x1"}}},
    {1402,
     8,
     {},
     {{"driver_steering_P_cmd", "24|8+ x0.1"},
      {"driver_steering_I_cmd", "32|8+ x0.1"},
      {"driver_steering_D_cmd", "40|8+ x0.01"},
      {"driver_steering_FF_cmd", "48|5+ x0.1"}}},
    {1406,
     8,
     {},
     {{"brake_bias_aim_switch", "8|4+ x1"},
      {"drive_steering_gain_cntrl_switch", "12|1+ x1"},
      {"push2pass_switch", "13|1+ x1"},
      {"drive_steering_FF_cntrl_switch", "14|1+ x1"}}},
    {1313,
     7,
     {},
     {{"motor_duty_cycle_cmd", "0|8- x1"},
      {"motor_duty_cycle_fbk", "8|8- x1"},
      {"motor_current_fbk", "16|8+ x1"},
      {"sbw_ecu_voltage", "24|8+ x0.1"},
      {"sbw_ecu_temp", "32|8+ x1"},
      {"sbw_error_code", "40|8+ x1"},
      {"sbw_motor_torque_estimate", "48|8+ x1"}}},
    {1314,
     8,
     {},
     {{"F_brk_pos_cmd", "0|16+ x-0.354"},
      {"F_brk_pos_fbk", "16|16+ x1"},
      {"R_brk_pos_cmd", "32|16+ x-0.354"},
      {"R_brk_pos_fbk", "48|16+ x1"}}},
    {1315, 4, {}, {{"f_brake_act_force", "0|12+ x1"}, {"r_brake_act_force", "16|12+ x1"}}},
    {1316,
     4,
     {},
     {{"steering_p_contribution", "0|10- x1"},
      {"steering_i_contribution", "10|10- x1"},
      {"steering_d_contribution", "20|10- x1"}}},
    {1344,
     8,
     {},
     {{"boost_aim_psi", "0|16+ x0.1"},
      {"boost_press_psi", "16|16- x0.1"},
      {"intake_manifold_press_kPa", "32|16- x0.1"},
      {"intake_air_temp_degC", "48|16- x0.1"}}},
    {1350, 8, {}, {{"novatel_lat", "0|32- x1e-07"}, {"novatel_long", "32|32- x1e-07"}}},
};

TEST(Av24, DiffersFromTheAv21InThisAndNothingElse) {
  const Database before = load(kOwnDbc), after = load(kAv24Dbc);
  std::set<std::uint32_t> changed;
  for (const Delta& delta : kDeltas) {
    changed.insert(delta.id);
    const Message* const now = after.find(delta.id);
    ASSERT_NE(now, nullptr) << delta.id;
    EXPECT_EQ(now->length, delta.length) << delta.id;
    const Message* const then = before.find(delta.id);
    Layout wanted = then == nullptr ? Layout{} : layout(*then);
    for (const auto& [name, text] : delta.gone) {
      EXPECT_EQ(wanted.at(name), text) << name;
      wanted.erase(name);
    }
    wanted.insert(delta.come.begin(), delta.come.end());
    EXPECT_EQ(layout(*now), wanted) << delta.id;
  }
  for (const Message& message : before.messages) {
    if (changed.contains(message.id)) continue;
    const Message* const now = after.find(message.id);
    ASSERT_NE(now, nullptr) << message.id;
    EXPECT_EQ(now->length, message.length) << message.id;
    EXPECT_EQ(layout(*now), layout(message)) << message.id;
  }
  EXPECT_EQ(after.messages.size(), before.messages.size() + 6);
}

TEST(Av24, IsGeneratedAndKnownByItsFingerprint) {
  const Database d = load(kAv24Dbc);
  EXPECT_EQ(av24::kFingerprint, fingerprint(d));
  EXPECT_NE(av24::kFingerprint, av21::kFingerprint);
  EXPECT_STREQ(av24::kDatabase, "av24.dbc");
  EXPECT_STREQ(av24::kRevision, "CAN1-INDY-V26");
  EXPECT_EQ(av24::kMessages.size(), d.messages.size());
  Frame frame;
  EncodeCounters counters;
  ASSERT_TRUE(av24::encode(av24::BrakePressureCmd{1000.0, 800.0, 7.0}, frame, counters));
  // The AV-21 would take the rear pressure for a counter and never see the real one.
  av21::BrakePressureCmd read;
  ASSERT_TRUE(av21::decode(frame, read));
  EXPECT_EQ(read.brake_pressure_cmd, 1000.0);
  EXPECT_EQ(read.brk_pressure_cmd_counter, 800 % 256);
}

}  // namespace
}  // namespace pitwall::can
