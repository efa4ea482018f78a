// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/radio_adapter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "protocol/telemetry/delivery/event_content.hpp"
#include "protocol/telemetry/endpoint/station_endpoint.hpp"
#include "protocol/telemetry/session/crypto/keys.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/pipeline/standing_car.hpp"

namespace pitwall::pipeline {
namespace {

using telemetry::CommandType;
using telemetry::Outcome;
using testing::setup;

const std::string kParameters = "car: some\n";

// Car and base with a wire between them, in virtual time.
class RadioAdapterRig : public ::testing::Test {
 protected:
  RadioAdapterRig() {
    telemetry::LinkEndpointConfig car, &base = base_config_;
    car.association.keys.own = telemetry::make_identity(random_);
    base.association.keys.role = telemetry::Role::kBase;
    base.association.keys.own = telemetry::make_identity(random_);
    car.association.keys.peer = base.association.keys.own.public_key;
    base.association.keys.peer = car.association.keys.own.public_key;
    car.association.peer[0] = kBaseAt;
    car_radio_.emplace(car, random_);
    base_radio_.emplace(base, random_);
    out_->place = {.s_m = 100.0, .n_m = 0.0};
  }

  void run(Duration span) {
    for (const Instant end = now_ + span; now_ < end; now_ = now_ + milliseconds(10)) tick();
  }
  void tick() {
    Inputs in{.now = now_, .dt = milliseconds(10), .can = {}, .sensors = none_, .requests = {}};
    adapter_.fill(*car_radio_, in);
    operator_inputs_ = in.operator_inputs;
    may_arm_ = in.may_arm;
    radio_at_ = in.radio_at;
    out_->answers = {};
    for (const world::OperatorCommand& command : in.commands) {
      commands_.push_back(command);
      EXPECT_TRUE(out_->answers.push({command.id, answer_, now_}));
    }
    adapter_.take(*car_radio_, setup(), *car_, *out_, now_);
    IoCounters figures;
    adapter_.show(*car_radio_, figures, now_);
    shown_ = figures;
    telemetry::Snapshot snapshot;
    snapshot.at(telemetry::Group::kMode) = now_;
    while (const auto out = car_radio_->poll(snapshot, now_))
      base_radio_->feed(out->bytes, out->path, kCarAt, now_);
    while (const auto out = base_radio_->poll(now_))
      car_radio_->feed(out->bytes, out->path, kBaseAt, now_);
    while (const auto object = base_radio_->next_bulk()) {
      if (object->kind == telemetry::BulkKind::kPath) path_ = telemetry::decode_path(object->bytes);
      if (object->kind == telemetry::BulkKind::kParameters)
        parameters_.assign(object->bytes.begin(), object->bytes.end());
    }
    for (const telemetry::ThreatChange& change : adapter_.threats()) threats_.push_back(change);
    while (const auto event = base_radio_->next_event()) ++events_, event_ = *event;
  }
  Outcome fate_of(CommandType type, double argument) {
    EXPECT_TRUE(base_radio_->authority().take(1, now_));
    run(milliseconds(100));
    const auto id = base_radio_->issue({.type = type, .argument = argument, .issuer = 1}, now_);
    EXPECT_TRUE(id);
    run(milliseconds(400));
    const auto* progress = id ? base_radio_->progress(*id) : nullptr;
    return progress != nullptr && progress->outcome ? *progress->outcome : Outcome::kReceived;
  }

  static constexpr UdpAddress kCarAt{1, 40'000}, kBaseAt{2, 23'431};
  telemetry::SeededRandomness random_{7};
  telemetry::LinkEndpointConfig base_config_;
  std::optional<telemetry::CarEndpoint> car_radio_;
  std::optional<telemetry::StationEndpoint> base_radio_;
  RadioAdapter adapter_{kParameters};
  std::unique_ptr<Car> car_ = std::make_unique<Car>();
  std::unique_ptr<Outputs> out_ = std::make_unique<Outputs>();
  world::SensorInput none_;
  Instant now_ = Instant{} + seconds(100);
  world::CommandAnswer answer_ = world::CommandAnswer::kApplied;
  world::OperatorInputs operator_inputs_;
  bool may_arm_ = true;
  std::optional<Instant> radio_at_;
  std::vector<world::OperatorCommand> commands_;
  IoCounters shown_;
  std::optional<telemetry::Path> path_;
  std::string parameters_;
  int events_ = 0;
  telemetry::Event event_;
  std::vector<telemetry::ThreatChange> threats_;
};

TEST_F(RadioAdapterRig, TheBaseIsAliveAndEndsThatAgreeMayArm) {
  tick();
  EXPECT_FALSE(radio_at_);
  run(seconds(1));
  ASSERT_TRUE(radio_at_);
  EXPECT_LT(now_ - *radio_at_, milliseconds(100));
  EXPECT_TRUE(may_arm_);
  EXPECT_TRUE(shown_.uplink.known);
  EXPECT_TRUE(shown_.uplink.schema_agrees);
  EXPECT_EQ(shown_.base_runs, 1u);
  EXPECT_GT(shown_.heartbeats, 10u);
}

TEST_F(RadioAdapterRig, EndsThatUnderstandSafetyDifferentlyDoNotArm) {
  base_config_.association.greeting.safety_schema = 1;
  base_radio_.emplace(base_config_, random_);
  run(seconds(1));
  ASSERT_TRUE(radio_at_) << "it is heard all the same";
  EXPECT_FALSE(may_arm_);
  EXPECT_FALSE(shown_.uplink.schema_agrees);
}

TEST_F(RadioAdapterRig, AStopOfTheOperatorIsAWishThatStays) {
  run(milliseconds(500));
  EXPECT_EQ(operator_inputs_.stop, world::StopRequest::kNone);
  base_radio_->stop().demand(telemetry::StopLevel::kControlled, telemetry::StopReason::kOperator);
  run(milliseconds(200));
  EXPECT_EQ(operator_inputs_.stop, world::StopRequest::kControlled);
  base_radio_->stop().demand(telemetry::StopLevel::kEmergency, telemetry::StopReason::kOperator);
  run(milliseconds(200));
  EXPECT_EQ(operator_inputs_.stop, world::StopRequest::kEmergency);
}

TEST_F(RadioAdapterRig, ThePipelinesAnswerIsTheCommandsFate) {
  run(milliseconds(500));
  EXPECT_EQ(fate_of(CommandType::kSpeedLimit, 30.0), Outcome::kApplied);
  answer_ = world::CommandAnswer::kRefused;
  EXPECT_EQ(fate_of(CommandType::kArm, 1.0), Outcome::kRefused);
  answer_ = world::CommandAnswer::kUnsupported;
  EXPECT_EQ(fate_of(CommandType::kRole, 1.0), Outcome::kUnsupported);
  answer_ = world::CommandAnswer::kExpired;
  EXPECT_EQ(fate_of(CommandType::kReset, 1.0), Outcome::kExpired);
  ASSERT_EQ(commands_.size(), 4u) << "each once";
  EXPECT_EQ(commands_[0].kind, world::OperatorCommandKind::kSpeedLimit);
  EXPECT_NEAR(commands_[0].argument, 30.0, 0.05);
}

TEST_F(RadioAdapterRig, TheRunEndsAtStandstillOnly) {
  run(milliseconds(500));
  EXPECT_EQ(fate_of(CommandType::kEndRun, 1.0), Outcome::kRefused);
  EXPECT_FALSE(adapter_.end_asked());
  out_->chosen.standstill = true;
  EXPECT_EQ(fate_of(CommandType::kEndRun, 1.0), Outcome::kApplied);
  EXPECT_TRUE(adapter_.end_asked());
  EXPECT_TRUE(commands_.empty()) << "no business of the pipeline";
}

TEST_F(RadioAdapterRig, ParametersAreSentWhenAskedFor) {
  run(milliseconds(500));
  EXPECT_EQ(fate_of(CommandType::kSendParameters, 1.0), Outcome::kApplied);
  run(seconds(1));
  EXPECT_EQ(parameters_, kParameters);
}

TEST_F(RadioAdapterRig, ThePathThatIsFollowedIsShown) {
  for (int i = 0; i < 40; ++i) {
    EXPECT_TRUE(
        car_->plan.output.drive.points.push({.x_m = 2.0 * i, .y_m = -1.0 * i, .speed_mps = 50.0}));
    EXPECT_TRUE(car_->plan.output.stop.points.push(
        {.x_m = 2.0 * i, .y_m = -1.0 * i, .speed_mps = 40.0 - i}));
  }
  run(seconds(3));
  ASSERT_TRUE(path_);
  ASSERT_EQ(path_->size(), 20u);
  EXPECT_NEAR((*path_)[3].x_m, 12.0, 0.006);
  EXPECT_NEAR((*path_)[3].speed_mps, 50.0, 0.006);
  car_->follow = safety::Follow::kStop;
  run(seconds(3));
  EXPECT_NEAR((*path_)[3].speed_mps, 34.0, 0.006);
}

TEST_F(RadioAdapterRig, WhatHappenedReachesTheBase) {
  run(milliseconds(500));
  out_->chosen.mode = world::Mode::kStandby;
  run(milliseconds(500));
  EXPECT_EQ(events_, 1);
  EXPECT_EQ(adapter_.events_missed(), 0u);
}

TEST_F(RadioAdapterRig, AnAttackOnTheCarReachesItsOwnLogTheBaseAndTheTelemetry) {
  run(seconds(1));
  EXPECT_EQ(shown_.threats, 0.0);
  const std::vector<std::uint8_t> noise(30, 0xFF);
  for (int i = 0; i < 1'000; ++i) {  // 50,000/s for 2 s
    for (int k = 0; k < 500; ++k) car_radio_->feed(noise, 0, {9, 9}, now_);
    tick();
    now_ = now_ + milliseconds(10);
    EXPECT_TRUE(i < 20 || shown_.threats == 4.0) << i;  // from 0.2 s on
  }
  constexpr auto kRate = telemetry::Threat::kRefusedAtRate;
  ASSERT_EQ(threats_.size(), 1U);
  EXPECT_EQ(threats_[0].threat, kRate);
  EXPECT_TRUE(threats_[0].begins);
  EXPECT_EQ(events_, 1);
  const auto content = telemetry::content_of(event_);
  ASSERT_TRUE(content);
  auto reported = std::get<telemetry::ThreatEvent>(*content);
  EXPECT_EQ(reported.threat, static_cast<std::uint8_t>(kRate));
  EXPECT_TRUE(reported.begins && !reported.seen_by_base);
  run(seconds(15));
  ASSERT_EQ(threats_.size(), 2U);
  EXPECT_EQ(events_, 2);
  reported = std::get<telemetry::ThreatEvent>(*telemetry::content_of(event_));
  EXPECT_FALSE(reported.begins);
  EXPECT_NEAR(reported.most_per_s, 50'000.0, 100.0);
  EXPECT_EQ(shown_.threats, 0.0);
}

TEST_F(RadioAdapterRig, NothingIsAllocated) {
  run(seconds(2));
  Inputs in{.now = now_, .dt = milliseconds(10), .can = {}, .sensors = none_, .requests = {}};
  IoCounters figures;
  const std::size_t allocations = pitwall::testing::allocations_of([&] {
    adapter_.fill(*car_radio_, in);
    adapter_.take(*car_radio_, setup(), *car_, *out_, now_);
    adapter_.show(*car_radio_, figures, now_);
  });
  if (pitwall::testing::kAllocationsCounted) {
    EXPECT_EQ(allocations, 0u);
  }
}

}  // namespace
}  // namespace pitwall::pipeline
