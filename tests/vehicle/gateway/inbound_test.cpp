// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/inbound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string_view>

#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/gateway/traffic.hpp"
#include "vehicle/gateway/flag_tables.hpp"

namespace pitwall::gateway {
namespace {

using namespace testing;
using can::ReceivedFrame;
using world::Liveness;
using world::TrackFlag;
using world::VehicleFlag;

struct InboundReceiver {
  InboundParams params;
  InboundState state;

  InboundOutput receive(const can::Frame& frame, Instant at) {
    const ReceivedFrame received{frame, at};
    return decode(params, state, {&received, 1}, at);
  }
  InboundOutput listen(Instant now) { return decode(params, state, {}, now); }
};

const world::MessageHealth& health_of(const world::BusHealth& bus, std::uint32_t id) {
  for (const world::MessageHealth& row : bus.messages)
    if (row.id == id) return row;
  ADD_FAILURE() << "no row for " << id;
  return bus.messages[0];
}

TEST(Inbound, HealthyTrafficIsAppliedInSi) {
  InboundReceiver car;
  InboundOutput out;
  for (std::int64_t tick = 0; tick < 100; ++tick) {
    const Instant at = at_ms(10 * tick);
    const auto counter = static_cast<std::uint8_t>(tick);
    car.receive(wheels(144.0), at);
    car.receive(brake(500.0, counter), at);
    out = car.receive(steering(-19.5, counter), at);
  }
  EXPECT_EQ(out.bus.refused.total(), 0u);
  EXPECT_EQ(out.bus.frames_applied, 300u);
  EXPECT_NEAR(out.signals.wheel_speed_mps.value[world::Corner::kRearLeft], 40.0, 1e-9);
  EXPECT_NEAR(out.signals.steering_motor_rad.value, -19.5 * 3.14159265358979 / 180.0, 1e-9);
  EXPECT_NEAR(out.signals.brake.value.rear_kpa, 500.0, 1e-9);
  EXPECT_FALSE(out.signals.powertrain.received);
  EXPECT_FALSE(out.own_id_seen);
}

TEST(Inbound, OnlyListedIdsOfTheCarInTheirOwnLengthAreRead) {
  for (std::uint32_t id = 0; id <= can::kMaxStandardId; ++id) {
    const can::MessageRow* row = nullptr;
    for (const can::MessageRow& candidate : av21::kMessages)
      if (candidate.id == id) row = &candidate;
    for (std::uint8_t length = 0; length <= 8; ++length) {
      InboundReceiver car;
      can::Frame frame;
      frame.id = id;
      frame.length = length;
      const InboundOutput out = car.receive(frame, at_ms(1));
      const bool ours = row != nullptr && row->direction == can::Direction::kToCar;
      const bool wrong_length = row != nullptr && !ours && length != row->length;
      EXPECT_EQ(out.bus.refused.unknown_id, row == nullptr ? 1u : 0u) << id;
      EXPECT_EQ(out.own_frames, ours ? 1u : 0u) << id;
      EXPECT_EQ(out.own_id_seen, ours) << id;
      EXPECT_EQ(out.bus.refused.wrong_length, wrong_length ? 1u : 0u) << id << ' ' << +length;
      EXPECT_EQ(out.bus.frames_applied + out.bus.refused.total() + out.own_frames, 1u) << id;
    }
  }
}

TEST(Inbound, RemoteFdAndExtendedAliasesAreRefused) {
  for (const can::MessageRow& row : av21::kMessages) {
    for (int kind = 0; kind < 3; ++kind) {
      InboundReceiver car;
      can::Frame frame = empty_frame(row);
      frame.extended = kind == 0;
      frame.remote = kind == 1;
      frame.fd = kind == 2;
      const InboundOutput out = car.receive(frame, at_ms(1));
      EXPECT_EQ(out.bus.refused.remote_or_error, 1u) << row.name;
      EXPECT_EQ(out.bus.frames_applied, 0u) << row.name;
      EXPECT_FALSE(out.own_id_seen) << row.name;
    }
  }
}

TEST(Inbound, AnotherNodeWithOurIdLatches) {
  InboundReceiver car;
  for (const can::MessageRow& row : av21::kMessages)
    if (row.direction == can::Direction::kToCar) car.receive(empty_frame(row), at_ms(1));
  const InboundOutput out = car.listen(at_ms(100000));
  EXPECT_TRUE(out.own_id_seen);
  EXPECT_EQ(out.own_frames, 8u);
}

TEST(Inbound, EveryConventionOfWrappingIsClean) {
  for (const int modulus : {8, 10, 100, 256}) {
    InboundReceiver car;
    InboundOutput out;
    for (std::int64_t i = 0; i < 600; ++i)
      out = car.receive(steering(5.0, static_cast<std::uint8_t>(i % modulus)), at_ms(10 * i));
    EXPECT_EQ(out.bus.refused.total(), 0u) << modulus;
    EXPECT_EQ(health_of(out.bus, av21::SteeringReport::kId).debt, 0) << modulus;
  }
}

TEST(Inbound, ARepeatedCounterIsNeverApplied) {
  InboundReceiver car;
  car.receive(steering(5.0, 7), at_ms(0));
  for (std::int64_t i = 1; i <= 50; ++i) {
    const InboundOutput out = car.receive(steering(6.0, 7), at_ms(10 * i));
    EXPECT_NEAR(out.signals.steering_motor_rad.value, 5.0 * 3.14159265358979 / 180.0, 1e-9);
    EXPECT_EQ(out.bus.refused.stuck_counter, static_cast<std::uint64_t>(i));
  }
  // Silence in all but name: the message is lost.
  const InboundOutput out = car.listen(at_ms(501));
  EXPECT_EQ(health_of(out.bus, av21::SteeringReport::kId).liveness, Liveness::kLost);
}

TEST(Inbound, AJumpingCounterFillsTheBucketAndAGoodOneEmptiesIt) {
  InboundReceiver car;
  std::int64_t tick = 0;
  std::uint8_t counter = 1;
  const auto send = [&](int step) {
    counter = static_cast<std::uint8_t>(counter + step);
    return car.receive(steering(1.0, counter), at_ms(10 * tick++));
  };
  const auto debt = [&] { return health_of(car.listen(at_ms(10 * tick - 10)).bus, 1303).debt; };
  send(1);
  // Ever farther than any loss of frames explains in the time that passed.
  for (int bad = 1; bad <= 4; ++bad) EXPECT_EQ(send(40).bus.refused.jumped_counter, 0u) << bad;
  EXPECT_EQ(debt(), 4);
  EXPECT_EQ(send(40).bus.refused.jumped_counter, 1u);
  int most = 0;
  for (int i = 0; i < 100; ++i) {
    send(i % 2 == 0 ? 40 : 90);
    most = std::max<int>(most, debt());
  }
  EXPECT_LE(most, 2 * car.params.fault_debt) << "bounded";
  EXPECT_GT(car.state.refused.jumped_counter, 50u);
  for (int good = 0; good < 2 * car.params.fault_debt; ++good) send(1);
  EXPECT_EQ(debt(), 0);
  const std::uint64_t applied = car.state.frames_applied;
  EXPECT_EQ(send(1).bus.frames_applied, applied + 1) << "recovered";
}

TEST(Inbound, LivenessFollowsAgeAndOnlyAppliedFramesCount) {
  const can::MessageRow& row =
      *std::find_if(av21::kMessages.begin(), av21::kMessages.end(),
                    [](const can::MessageRow& r) { return r.id == av21::WheelSpeedReport::kId; });
  InboundReceiver car;
  const auto at = [&](Duration age) {
    return health_of(car.listen(Instant{} + age).bus, row.id).liveness;
  };
  EXPECT_EQ(at({}), Liveness::kNever);
  car.receive(wheels(10.0), Instant{});
  const Duration late = row.period * 5 / 2;
  EXPECT_EQ(at(late), Liveness::kAlive);
  EXPECT_EQ(at(late + nanoseconds(1)), Liveness::kLate);
  EXPECT_EQ(at(row.timeout), Liveness::kLate);
  EXPECT_EQ(at(row.timeout + nanoseconds(1)), Liveness::kLost);
  can::Frame alien = wheels(10.0);
  alien.length = 7;
  car.receive(alien, Instant{} + row.timeout);
  EXPECT_EQ(at(row.timeout + nanoseconds(1)), Liveness::kLost);
}

double limit_per_s(std::uint32_t id, std::string_view signal) {
  for (const can::SlewRow& row : av21::kSlews)
    if (row.id == id && row.signal == signal) return row.max_per_s;
  return HUGE_VAL;
}

TEST(Inbound, RandomTrafficNeverAppliesAnImplausibleValue) {
  InboundReceiver car;
  Random random{20260101};
  std::uint64_t sent = 0;
  InboundOutput before = car.listen(Instant{});
  Instant now{};
  for (int i = 0; i < 200'000; ++i) {
    now += microseconds(static_cast<std::int64_t>(random.below(4000)));
    can::Frame frame = empty_frame(av21::kMessages[random.below(av21::kMessages.size())]);
    for (std::size_t b = 0; b < frame.length; ++b)
      frame.data[b] = static_cast<std::uint8_t>(random.next());
    if (random.below(3) == 0)  // near the truth, so that slews are exercised and not only ranges
      for (std::size_t b = 1; b < frame.length; b += 2)
        frame.data[b] = static_cast<std::uint8_t>(random.below(4));
    if (random.below(50) == 0) frame.length = static_cast<std::uint8_t>(random.below(9));
    if (random.below(50) == 0) frame.id = static_cast<std::uint32_t>(random.below(2048));
    const InboundOutput out = car.receive(frame, now);
    ++sent;
    ASSERT_EQ(out.bus.frames_applied + out.bus.refused.total() + out.own_frames, sent);
    std::uint64_t by_message = 0;
    for (const world::MessageHealth& row : out.bus.messages) by_message += row.bad;
    ASSERT_EQ(by_message + out.bus.refused.unknown_id, out.bus.refused.total());
    const world::VehicleSignals &s = out.signals, &was = before.signals;
    for (std::size_t w = 0; w < world::kCorners; ++w) {
      if (!s.wheel_speed_mps.received) continue;
      const double v = s.wheel_speed_mps.value.at[w];
      ASSERT_TRUE(v >= 0.0 && v <= car.params.wheel_speed_mps.max);
      if (!was.wheel_speed_mps.received) continue;
      const double gap_s =
          std::max(0.005, (s.wheel_speed_mps.at - was.wheel_speed_mps.at).seconds());
      const double limit = from_kmh(limit_per_s(av21::WheelSpeedReport::kId, "wheel_speed_FL"));
      ASSERT_LE(std::abs(v - was.wheel_speed_mps.value.at[w]), limit * gap_s + 1e-6);
    }
    if (s.steering_motor_rad.received) {
      ASSERT_LE(std::abs(s.steering_motor_rad.value), from_deg(300.0) + 1e-9);
      if (was.steering_motor_rad.received) {
        const double gap_s =
            std::max(0.01, (s.steering_motor_rad.at - was.steering_motor_rad.at).seconds());
        const double limit =
            from_deg(limit_per_s(av21::SteeringReport::kId, "steering_motor_ang_avg_fdbk"));
        ASSERT_LE(std::abs(s.steering_motor_rad.value - was.steering_motor_rad.value),
                  limit * gap_s + 1e-6);
      }
    }
    if (s.misc.received) {
      ASSERT_TRUE(s.misc.value.battery_v >= 0.0 && s.misc.value.battery_v <= 20.0);
    }
    if (s.powertrain.received) {
      ASSERT_LE(s.powertrain.value.gear, car.params.gear_max);
      ASSERT_LE(s.powertrain.value.gear_shift_status, 4);
      ASSERT_LE(s.powertrain.value.engine_speed_rpm, car.params.engine_speed_rpm.max);
    }
    for (const double t_c : s.tyre_temperature_c.value.at)
      ASSERT_TRUE(std::isnan(t_c) || (t_c >= -40.0 && t_c <= 250.0));
    before = out;
  }
  EXPECT_GT(car.state.frames_applied, 1000u);
  EXPECT_GT(car.state.refused.implausible_slew, 20u);
  EXPECT_GT(car.state.refused.out_of_range, 100u);
}

TEST(Inbound, AWrongFirstValueDoesNotLockOutTheTruth) {
  InboundReceiver car;
  car.receive(steering(290.0, 0), at_ms(0));
  std::int64_t tick = 1;
  while (car.state.refused.implausible_slew < 1 || car.state.frames_applied < 2) {
    ASSERT_LT(tick, 1000) << "never recovered";
    car.receive(steering(0.0, static_cast<std::uint8_t>(tick)), at_ms(10 * tick));
    ++tick;
  }
  EXPECT_NEAR(car.state.signals.steering_motor_rad.value, 0.0, 1e-12);
}

TEST(Inbound, AFlagIsTakenEvenWithAStuckHeartbeatButLivenessIsNot) {
  InboundReceiver car;
  car.receive(summary({.heartbeat = 3, .track = 4}), at_ms(0));
  const InboundOutput out = car.receive(summary({.heartbeat = 3, .track = 1}), at_ms(500));
  EXPECT_EQ(out.race_control.track, TrackFlag::kRed);
  EXPECT_EQ(out.race_control.last_heartbeat_change, at_ms(0));
  const InboundOutput later = car.receive(summary({.heartbeat = 4, .track = 1}), at_ms(1000));
  EXPECT_EQ(later.race_control.last_heartbeat_change, at_ms(1000));
  EXPECT_TRUE(later.race_control.ever_received);
}

TEST(Inbound, MarelliIsAliveWhileItsReceiverHearsTheBase) {
  InboundReceiver car;
  car.params.flag_encoding = world::FlagEncoding::kMarelli;
  car.receive(marelli({.track = 1}), at_ms(0));
  car.receive(marelli({.track = 1}), at_ms(500));
  const InboundOutput out = car.receive(marelli({.track = 3, .synchronised = false}), at_ms(1000));
  EXPECT_EQ(out.race_control.last_heartbeat_change, at_ms(500));
  EXPECT_EQ(out.race_control.track, TrackFlag::kRed);
}

TEST(Inbound, TheSecondEncodingCanOnlyRestrict) {
  for (const auto main : {world::FlagEncoding::kMyLaps, world::FlagEncoding::kMarelli}) {
    const bool mylaps_leads = main == world::FlagEncoding::kMyLaps;
    for (int m = 0; m < 16; ++m) {
      for (int v = 0; v < 256; ++v) {
        InboundReceiver car;
        car.params.flag_encoding = main;
        const auto raw = static_cast<std::uint8_t>(v);
        const auto nibble = static_cast<std::uint8_t>(m);
        car.receive(summary({.track = nibble, .vehicle = nibble}), at_ms(0));
        const auto rc = car.receive(marelli({.track = raw, .vehicle = raw}), at_ms(0)).race_control;
        const TrackFlag track_a = track_meaning(world::FlagEncoding::kMyLaps, nibble).flag;
        const TrackFlag track_b = track_meaning(world::FlagEncoding::kMarelli, raw).flag;
        const TrackFlag lead = mylaps_leads ? track_a : track_b;
        const TrackFlag other = mylaps_leads ? track_b : track_a;
        ASSERT_EQ(more_restrictive(rc.track, lead), rc.track) << m << ' ' << v;
        ASSERT_TRUE(rc.track == lead || rc.track == other);
        if (other != TrackFlag::kNone) {
          ASSERT_EQ(more_restrictive(rc.track, other), rc.track) << m << ' ' << v;
        }
        const VehicleFlag vehicle_a = vehicle_meaning(world::FlagEncoding::kMyLaps, nibble);
        const VehicleFlag vehicle_b = vehicle_meaning(world::FlagEncoding::kMarelli, raw);
        const VehicleFlag vehicle_lead = mylaps_leads ? vehicle_a : vehicle_b;
        const VehicleFlag vehicle_other = mylaps_leads ? vehicle_b : vehicle_a;
        ASSERT_EQ(more_restrictive(rc.vehicle, vehicle_lead), rc.vehicle);
        ASSERT_TRUE(rc.vehicle == vehicle_lead || rc.vehicle == vehicle_other);
        if (vehicle_other != VehicleFlag::kNone) {
          ASSERT_EQ(more_restrictive(rc.vehicle, vehicle_other), rc.vehicle) << m << ' ' << v;
        }
        const bool spoken = (track_a != TrackFlag::kNone || vehicle_a != VehicleFlag::kNone) &&
                            (track_b != TrackFlag::kNone || vehicle_b != VehicleFlag::kNone);
        if (!spoken || demand_of(track_a, vehicle_a) != demand_of(track_b, vehicle_b)) {
          ASSERT_EQ(rc.conflict, spoken) << m << ' ' << v;
        }
        ASSERT_EQ(rc.raw_track, mylaps_leads ? nibble : raw);
        ASSERT_EQ(rc.other_raw_vehicle, mylaps_leads ? raw : nibble);
      }
    }
  }
}

// Each encoding has flags that the other lacks, and its own way to say them.
TEST(Inbound, TwoWaysToSayOneThingAreNoConflictAndTwoThingsAre) {
  struct Case {
    std::uint8_t mylaps_track, mylaps_vehicle, marelli_track, marelli_vehicle;
    bool conflict;
  };
  for (const Case c : {Case{1, 0, 1, 34, false},    // red; stop beside green
                       Case{3, 4, 4, 0, false},     // chequered as a vehicle flag; as the track's
                       Case{2, 0, 0, 25, false},    // orange
                       Case{4, 7, 1, 36, false},    // attacker
                       Case{4, 7, 1, 35, true},     // attacker and defender
                       Case{8, 7, 1, 36, true},     // waving and green
                       Case{4, 0, 9, 0, true},      // green and yellow
                       Case{4, 2, 1, 0, true},      // black in one alone
                       Case{4, 0, 0, 0, false}}) {  // the other says nothing
    InboundReceiver car;
    car.receive(summary({.track = c.mylaps_track, .vehicle = c.mylaps_vehicle}), at_ms(0));
    const auto rc =
        car.receive(marelli({.track = c.marelli_track, .vehicle = c.marelli_vehicle}), at_ms(0));
    EXPECT_EQ(rc.race_control.conflict, c.conflict)
        << int{c.mylaps_track} << ' ' << int{c.marelli_track} << ' ' << int{c.marelli_vehicle};
  }
}

TEST(Inbound, TheLowerOfTwoRoundSpeedsHoldsAndZeroIsNoTarget) {
  InboundReceiver car;
  auto rc = car.receive(summary({.track = 4, .speed_mph = 0}), at_ms(0)).race_control;
  EXPECT_TRUE(std::isnan(rc.round_target_speed_mps));
  rc = car.receive(summary({.heartbeat = 1, .track = 4, .speed_mph = 100}), at_ms(1)).race_control;
  EXPECT_NEAR(rc.round_target_speed_mps, 44.704, 1e-9);
  rc = car.receive(marelli({.track = 80}), at_ms(2)).race_control;
  EXPECT_NEAR(rc.round_target_speed_mps, 35.7632, 1e-9);
  rc = car.receive(marelli({.track = 125}), at_ms(3)).race_control;
  EXPECT_NEAR(rc.round_target_speed_mps, 44.704, 1e-9);
}

TEST(Inbound, TheStateIsAValueAndTakesNothingFromTheHeap) {
  InboundReceiver car;
  Random random{7};
  std::vector<ReceivedFrame> frames;
  for (int i = 0; i < 500; ++i) {
    can::Frame frame = empty_frame(av21::kMessages[random.below(av21::kMessages.size())]);
    for (std::size_t b = 0; b < frame.length; ++b)
      frame.data[b] = static_cast<std::uint8_t>(random.next());
    frames.push_back({frame, at_ms(i)});
  }
  InboundState copy = car.state;
  InboundOutput first, second;
  const std::size_t taken = ::pitwall::testing::allocations_of(
      [&] { first = decode(car.params, car.state, frames, at_ms(500)); });
  if (::pitwall::testing::kAllocationsCounted) {
    EXPECT_EQ(taken, 0u);
  }
  second = decode(car.params, copy, frames, at_ms(500));
  EXPECT_EQ(first.bus.frames_applied, second.bus.frames_applied);
  EXPECT_EQ(first.bus.refused.total(), second.bus.refused.total());
  EXPECT_EQ(first.bus.frames_lost, second.bus.frames_lost);
  EXPECT_EQ(0, std::memcmp(&car.state.messages, &copy.messages, sizeof copy.messages));
}

}  // namespace
}  // namespace pitwall::gateway
