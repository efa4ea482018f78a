// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/event_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <variant>
#include <vector>

#include "protocol/telemetry/delivery/event_content.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/pipeline/mapped_car.hpp"

namespace pitwall::pipeline {
namespace {

using safety::Cause;
using telemetry::EventContent;
using telemetry::FaultEvent;
using telemetry::FlagEvent;
using telemetry::FlagKind;
using telemetry::LapEvent;
using testing::kNow;

class Events : public ::testing::Test {
 protected:
  std::vector<EventContent> look(Instant now = kNow) {
    std::vector<EventContent> contents;
    for (const telemetry::Event& event : detector_.detect(*car_, *out_, now))
      contents.push_back(telemetry::content_of(event).value());
    return contents;
  }
  void raise(Cause cause, double value, bool stays = true) {
    car_->supervisor.log.record({.at = kNow, .cause = cause, .value = value}, true);
    if (stays) out_->chosen.causes.add(cause);
  }

  std::unique_ptr<Car> car_ = std::make_unique<Car>();
  std::unique_ptr<Outputs> out_ = std::make_unique<Outputs>();
  EventDetector detector_;
};

TEST_F(Events, ACarThatWasSwitchedOnHasNothingToTell) {
  EXPECT_TRUE(look().empty());
  EXPECT_TRUE(look().empty());
}

TEST_F(Events, EveryFaultIsToldWhenItBeginsAndWhenItEnds) {
  raise(Cause::kRadioLost, 3.5);
  raise(Cause::kBusOff, NAN);
  raise(Cause::kImuLost, 1.0, false);  // came and went within a tick
  EXPECT_EQ(look(),
            (std::vector<EventContent>{FaultEvent{31, true, 3.5F}, FaultEvent{16, true, 0},
                                       FaultEvent{28, true, 1.0F}, FaultEvent{28, false, 0}}));
  EXPECT_TRUE(look().empty());
  out_->chosen.causes = {};
  out_->chosen.causes.add(Cause::kBusOff);
  EXPECT_EQ(look(), (std::vector<EventContent>{FaultEvent{31, false, 0}}));
  out_->chosen.causes = {};
  EXPECT_EQ(look(), (std::vector<EventContent>{FaultEvent{16, false, 0}}));
}

TEST_F(Events, AFaultWhoseBeginningWasNotToldHasNoEnd) {
  out_->chosen.causes.add(Cause::kGnssRateLost);  // holds in the garage, and is not logged
  EXPECT_TRUE(look().empty());
  out_->chosen.causes = {};
  EXPECT_TRUE(look().empty());
}

TEST_F(Events, FaultsThatTheLogOrTheTickHadNoRoomForAreCounted) {
  for (std::size_t i = 0; i < safety::kFaultEntries + 7; ++i) raise(Cause::kBusOff, 1.0);
  EXPECT_EQ(look().size(), TickEvents::capacity());
  EXPECT_EQ(detector_.missed(), safety::kFaultEntries + 7 - TickEvents::capacity());
}

TEST_F(Events, ModeArmingAndFlagsAreToldWhenTheyChange) {
  out_->chosen.mode = world::Mode::kStandby;
  out_->chosen.arming = safety::Arming::kArmed;
  out_->received.race_control.track = world::TrackFlag::kGreen;  // not heard: a default, no flag
  EXPECT_EQ(look(),
            (std::vector<EventContent>{telemetry::ModeEvent{0, 1, 0}, telemetry::ArmingEvent{1}}));
  out_->received.race_control.ever_received = true;
  out_->received.race_control.vehicle = world::VehicleFlag::kBlue;
  EXPECT_EQ(look(), (std::vector<EventContent>{FlagEvent{FlagKind::kTrack, 0, 4},
                                               FlagEvent{FlagKind::kVehicle, 0, 2}}));
  EXPECT_TRUE(look().empty());
}

TEST_F(Events, ALapHasItsTimeWhereItsBeginningWasSeen) {
  out_->received.race_control.ever_received = true;
  out_->received.race_control.lap_count = 1;
  auto reported = look(kNow);
  ASSERT_EQ(reported.size(), 1u);
  EXPECT_EQ(std::get<LapEvent>(reported[0]).number, 1);
  EXPECT_TRUE(std::isnan(std::get<LapEvent>(reported[0]).time_s));
  out_->received.race_control.lap_count = 2;
  EXPECT_EQ(look(kNow + seconds(38)), (std::vector<EventContent>{LapEvent{2, 38.0F}}));
  out_->received.race_control.lap_count = 5;  // some were not heard
  reported = look(kNow + seconds(150));
  EXPECT_TRUE(std::isnan(std::get<LapEvent>(reported.at(0)).time_s));
}

TEST_F(Events, NothingIsAllocated) {
  raise(Cause::kRadioLost, 3.5);
  out_->chosen.mode = world::Mode::kStandby;
  EXPECT_EQ(pitwall::testing::allocations_of([&] { detector_.detect(*car_, *out_, kNow); }), 0u);
}

}  // namespace
}  // namespace pitwall::pipeline
