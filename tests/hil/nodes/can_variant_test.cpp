// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/can_variant.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "protocol/can/av21.hpp"
#include "protocol/can/av24.hpp"
#include "protocol/can/decode.hpp"
#include "protocol/can/difference.hpp"
#include "tests/support/public_data.hpp"

namespace pitwall::can_variant {
namespace {

namespace av21 = can::av21;
using scenario::BusRevision;

CanVariant made(BusRevision which) {
  auto revision = CanVariant::of(which);
  EXPECT_TRUE(revision) << to_string(revision.error());
  return *std::move(revision);
}

template <class Message>
can::Frame frame_of(const Message& message) {
  can::Frame frame;
  can::EncodeCounters counters;
  EXPECT_TRUE(av21::encode(message, frame, counters));
  return frame;
}

// Every message that the car hears, its fields 1, 2, 3 ... where the field can say so.
std::vector<can::Frame> model_frames() {
  std::vector<can::Frame> frames;
  const auto add = [&frames](auto message) {
    using Message = decltype(message);
    double value = 0.0;
    for (const auto field : Message::kFields) message.*field = value += 1.0;
    can::Frame frame;
    can::EncodeCounters counters;
    EXPECT_TRUE(av21::encode(message, frame, counters));
    frames.push_back(frame);
  };
  std::apply([&](auto... message) { (add(message), ...); }, av21::AllMessages{});
  return frames;
}

double value_in(const can::Database& database, const can::Frame& frame, const char* signal) {
  const can::Message* const message = database.find(frame.id);
  EXPECT_NE(message, nullptr) << frame.id;
  EXPECT_TRUE(can::is_frame_of(*message, frame)) << frame.id;
  const can::Signal* const found = message->find(signal);
  EXPECT_NE(found, nullptr) << signal;
  return found == nullptr ? kUnset : can::decode(*found, frame);
}

TEST(CanVariant, V14ChangesNothing) {
  CanVariant v14 = made(BusRevision::kV14);
  for (const can::Frame& frame : model_frames()) {
    const Frames transmitted = v14.transmitted(frame);
    ASSERT_EQ(transmitted.size(), 1u);
    EXPECT_EQ(transmitted[0], frame);
    EXPECT_EQ(v14.receive(frame), frame);
  }
  EXPECT_TRUE(v14.due(Instant{} + seconds(10)).empty());
}

// Law: what is said in any revision is a frame of its database, and every value that has the same
// name in both is the same there, within the coarser resolution.
TEST(CanVariant, WhatIsSaidMeansTheSame) {
  CanVariant v14 = made(BusRevision::kV14);
  for (const BusRevision which : {BusRevision::kV9, BusRevision::kV12, BusRevision::kAv24}) {
    CanVariant other = made(which);
    std::size_t compared = 0;
    for (const can::Frame& frame : model_frames()) {
      const can::Message* const model = v14.database().find(frame.id);
      ASSERT_NE(model, nullptr);
      for (const can::Frame& stated : other.transmitted(frame)) {
        const can::Message* const message = other.database().find(stated.id);
        ASSERT_NE(message, nullptr) << stated.id;
        ASSERT_TRUE(can::is_frame_of(*message, stated)) << message->name;
        for (const can::Signal& signal : message->signals) {
          const can::Signal* const same = model->find(signal.name);
          if (same == nullptr || message->name != model->name) continue;
          const double coarse = std::max(signal.layout.scale, same->layout.scale);
          EXPECT_NEAR(can::decode(signal, stated), can::decode(*same, frame), 0.51 * coarse)
              << message->name << "." << signal.name;
          ++compared;
        }
      }
    }
    EXPECT_GT(compared, 100u) << scenario::name_of(which);
    EXPECT_EQ(other.unsent(), 0u);
  }
}

TEST(CanVariant, V9HasNoMarelliAndTenBitsOfSteering) {
  CanVariant v9 = made(BusRevision::kV9);
  for (const std::uint32_t id : {1250u, 1251u, 1405u, 1406u, 1450u})
    EXPECT_EQ(v9.database().find(id), nullptr) << id;
  av21::SteeringReport report;
  report.steering_motor_ang_avg_fdbk = -1.0;
  report.steering_motor_fdbk_counter = 7;
  const Frames stated = v9.transmitted(frame_of(report));
  ASSERT_EQ(stated.size(), 1u);
  EXPECT_EQ(value_in(v9.database(), stated[0], "steering_motor_ang_avg_fdbk"), -1.0);
  // What a V14 car would read: the reason for all of this.
  ASSERT_TRUE(av21::decode(stated[0], report));
  EXPECT_EQ(report.steering_motor_ang_avg_fdbk, 511.0);
}

TEST(CanVariant, V12SaysMarelliInThreeMessages) {
  CanVariant v12 = made(BusRevision::kV12);
  av21::MarelliReport1 flags{9, 25, 3, 1, -70};
  const Frames stated = v12.transmitted(frame_of(flags));
  ASSERT_EQ(stated.size(), 2u);
  EXPECT_EQ(stated[0].id, 1000u);
  EXPECT_EQ(value_in(v12.database(), stated[0], "Marelli_Track_Flag"), 9.0);
  EXPECT_EQ(value_in(v12.database(), stated[0], "Marelli_Vehicle_Flag"), 25.0);
  EXPECT_EQ(stated[1].id, 1001u);
  EXPECT_EQ(value_in(v12.database(), stated[1], "lte_sync_ok"), 1.0);
  EXPECT_EQ(value_in(v12.database(), stated[1], "lte_modem_lte_rssi"), -70.0);
  const Frames position = v12.transmitted(frame_of(av21::MarelliReport2{36.25, -115.0}));
  ASSERT_EQ(position.size(), 1u);
  EXPECT_EQ(position[0].id, 1002u);
  EXPECT_NEAR(value_in(v12.database(), position[0], "GPS_Lon"), -115.0, 1e-7);
}

// A command of a V14 car, read by another drive-by-wire as its own database says.
TEST(CanVariant, CommandsAreReadByTheLayoutOfTheRevision) {
  CanVariant v9 = made(BusRevision::kV9), v12 = made(BusRevision::kV12);
  CanVariant av24 = made(BusRevision::kAv24);
  const auto steering = v9.receive(frame_of(av21::SteeringCmd{300.0, 5}));
  ASSERT_TRUE(steering);
  av21::SteeringCmd read;
  ASSERT_TRUE(av21::decode(*steering, read));
  EXPECT_EQ(read.steering_motor_ang_cmd, 300.0 - 512.0) << "the eleventh bit is not read";
  // 1405 says flags in V14 and switches in V12.
  const auto acks = v12.receive(frame_of(av21::CtReport2{0x21, 0, 0}));
  ASSERT_TRUE(acks);
  av21::DashSwitchesCmd dash;
  ASSERT_TRUE(av21::decode(*acks, dash));
  EXPECT_EQ(dash.driver_traction_aim_switch, 1.0);
  EXPECT_EQ(dash.driver_traction_range_switch, 2.0);
  const auto brake = av24.receive(frame_of(av21::BrakePressureCmd{1234.0, 200}));
  ASSERT_TRUE(brake);
  av21::BrakePressureCmd pressed;
  ASSERT_TRUE(av21::decode(*brake, pressed));
  EXPECT_EQ(pressed.brake_pressure_cmd, 1234.0);
  EXPECT_EQ(pressed.brk_pressure_cmd_counter, 0.0) << "it looks for the counter at bit 40";
}

TEST(CanVariant, TheAv24SendsItsOwnMessagesAtTheirPeriod) {
  CanVariant av24 = made(BusRevision::kAv24);
  std::map<std::uint32_t, int> received;
  for (Instant now{}; now - Instant{} < seconds(2); now += milliseconds(1))
    for (const can::Frame& frame : av24.due(now)) {
      ++received[frame.id];
      EXPECT_EQ(av21::kMessages.end(),
                std::ranges::find(av21::kMessages, frame.id, &can::MessageRow::id));
    }
  const std::map<std::uint32_t, int> wanted{{1313, 20}, {1314, 20}, {1315, 20},
                                            {1316, 20}, {1344, 20}, {1350, 200}};
  EXPECT_EQ(received, wanted);
  EXPECT_TRUE(made(BusRevision::kV9).due(Instant{} + seconds(1)).empty());
}

// Equal to the public files bit for bit; tests/protocol/can computes their fingerprints.
TEST(CanVariant, V9V12AndV14AreThePublicFiles) {
  for (const auto& [which, expected] :
       {std::pair{BusRevision::kV9, recordings::kFingerprintOfV9},
        std::pair{BusRevision::kV12, recordings::kFingerprintOfV12},
        std::pair{BusRevision::kV14, recordings::kFingerprintOfV14}})
    EXPECT_EQ(can::fingerprint(made(which).database()), expected) << scenario::name_of(which);
}

std::string changes(const CanVariant& from, const CanVariant& to) {
  std::string out;
  for (const can::Difference& d : can::differences(from.database(), to.database()))
    out += std::string(can::name_of(can::severity_of(d.change))) + " " + d.text + "\n";
  return out;
}

// What the published history of the car's bus says of these three revisions.
TEST(CanVariant, DifferAsThePublishedHistoryOfTheBusSays) {
  const CanVariant nine = made(BusRevision::kV9), twelve = made(BusRevision::kV12);
  const CanVariant fourteen = made(BusRevision::kV14);
  const std::string older = changes(nine, twelve);
  for (const char* line :
       {"misread steering_report (1303): steering_motor_ang_avg_fdbk grew from 10 to 11 bits: what "
        "one writes as -1 deg the other reads as +511\n",
        "misread steering_cmd (1402): steering_motor_ang_cmd grew from 10 to 11 bits: what one "
        "writes as -1 deg the other reads as +511\n",
        "missing dash_switches_cmd (1405) is new\n",
        "missing pt_report_3 (1343): torque_wheels is new\n",
        "misread wheel_potentiometer_data (1311): wheel_potentiometer_FL grew from 8 to 16 bits; "
        "has "
        "the scale 0.01, had 0.2: what one writes as 51 mm the other reads as 2.55\n"}) {
    EXPECT_NE(older.find(line), std::string::npos) << line << older;
  }
  const std::string newer = changes(twelve, fourteen);
  EXPECT_TRUE(newer.starts_with(
      "misread 1405: dash_switches_cmd has become ct_report_2, another message\n"
      "misread 1406: ct_vehicle_acc_feedback has become dash_switches_cmd, another message\n"))
      << newer;
  for (const char* line :
       {"missing dash_switches_cmd moved from 1405 to 1406\n",
        "missing marelli_report_1 moved from 1000 to 1250\n",
        "missing position_heading (1500) is gone\n",
        "meaning marelli_report_1 (1250): Marelli_Track_Flag is now called marelli_track_flag\n"}) {
    EXPECT_NE(newer.find(line), std::string::npos) << line << newer;
  }
}

}  // namespace
}  // namespace pitwall::can_variant
