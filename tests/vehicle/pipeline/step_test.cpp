// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/pipeline/standing_car.hpp"
#include "vehicle/pipeline/telemetry_mapper.hpp"

namespace pitwall::pipeline {
namespace {

using testing::kStart;
using testing::kTick;
using testing::Received;
using testing::setup;
using testing::StandingCar;
using world::Mode;

// ct_report, ct_report_2, dash_switches_cmd, ct_vehicle_acc_feedback: written here by hand, on
// purpose not taken from the database.
const std::set<std::uint32_t> kStatusIds{1404, 1405, 1406, 1450};

bool commands_actuators(const Outputs& out) {
  return std::any_of(out.passed.frames.begin(), out.passed.frames.end(),
                     [](const can::Frame& f) { return !kStatusIds.contains(f.id); });
}

bool is_located(const world::EgoState& ego) {
  return ego.validity == world::Validity::kGood || ego.validity == world::Validity::kDeadReckoning;
}

using ReceivedSource = std::function<Received(Instant)>;

Outputs tick(Car& car, const Received& incoming, Instant now) {
  return step(setup(), car, incoming.inputs(now));
}

// Runs and shows every tick to `watch`.
void run(Car& car, Duration span, const ReceivedSource& source,
         const std::function<void(const Outputs&)>& watch) {
  for (Instant now = kStart; now < kStart + span; now += kTick) {
    watch(tick(car, source(now), now));
    if (::testing::Test::HasFatalFailure()) return;
  }
}

Received nothing(Instant) { return {}; }

ReceivedSource noise(std::uint64_t seed) {
  auto random = std::make_shared<Random>(Random{seed});
  return [random](Instant now) {
    Received incoming;
    for (std::uint64_t n = random->below(60); n > 0; --n)
      incoming.frames.push_back(testing::random_frame(*random, now));
    if (random->one_in(2)) testing::random_samples(*random, now, incoming.sensors);
    return incoming;
  };
}

std::unique_ptr<Car> new_car() { return std::make_unique<Car>(); }

// ---- What leaves the car

TEST(Step, WithoutInputOnlyStatusFramesLeave) {
  for (const bool arm : {false, true}) {
    const auto car = new_car();
    std::set<std::uint32_t> ids;
    run(
        *car, seconds(5),
        [arm](Instant) {
          Received incoming;
          incoming.requests.arm = arm;
          return incoming;
        },
        [&](const Outputs& out) {
          for (const can::Frame& frame : out.passed.frames) ids.insert(frame.id);
          ASSERT_EQ(out.chosen.mode, Mode::kDisarmed);
          ASSERT_FALSE(out.chosen.actuate);
          ASSERT_FALSE(out.passed.refused_now);
        });
    // 1450 carries accelerations, which nobody has measured yet.
    EXPECT_EQ(ids, (std::set<std::uint32_t>{1404, 1405, 1406})) << "arm " << arm;
  }
}

TEST(Step, ADisarmedCarSendsStatusOnly) {
  const auto car = new_car();
  StandingCar source;
  std::set<std::uint32_t> ids;
  run(
      *car, seconds(5), [&](Instant now) { return source.receive(now); },
      [&](const Outputs& out) {
        for (const can::Frame& frame : out.passed.frames) ids.insert(frame.id);
      });
  EXPECT_EQ(ids, kStatusIds);
}

TEST(Step, StatusFramesKeepTheirRateWithoutInput) {
  const auto car = new_car();
  std::size_t reports = 0;
  run(*car, seconds(5), nothing, [&](const Outputs& out) {
    for (const can::Frame& frame : out.passed.frames) reports += frame.id == 1404 ? 1U : 0U;
  });
  EXPECT_NEAR(static_cast<double>(reports), 500.0, 1.0);
}

// The healthy car is the counter-example to the tests that nothing drives.
TEST(Step, AHealthyCarDrivesWhenRaceControlLetsItAndTheOperatorArmed) {
  const auto car = new_car();
  StandingCar source;
  bool drove = false, throttle = false;
  run(
      *car, seconds(5),
      [&](Instant now) {
        Received incoming = source.receive(now);
        incoming.requests.arm = now > kStart + seconds(2);
        return incoming;
      },
      [&](const Outputs& out) {
        drove = drove || out.chosen.mode == Mode::kDriving;
        throttle =
            throttle || (commands_actuators(out) && out.chosen.command.throttle_fraction > 0);
      });
  EXPECT_TRUE(drove);
  EXPECT_TRUE(throttle);
}

// A bus on which race control is silent is not that of the database.
TEST(Step, WithoutRaceControlACarDoesNotArm) {
  const auto car = new_car();
  StandingCar source;
  source.race_control = false;
  run(
      *car, seconds(8),
      [&](Instant now) {
        Received incoming = source.receive(now);
        incoming.requests.arm = true;
        return incoming;
      },
      [&](const Outputs& out) {
        ASSERT_EQ(out.chosen.mode, Mode::kDisarmed);
        ASSERT_FALSE(commands_actuators(out));
      });
}

TEST(Step, OnABusOfAnotherRevisionACarDoesNotArm) {
  const auto car = new_car();
  StandingCar source;
  run(
      *car, seconds(8),
      [&](Instant now) {
        Received incoming = source.receive(now);
        incoming.requests.arm = true;
        for (can::ReceivedFrame& received : incoming.frames)
          if (received.frame.id == 1312) received.frame.length = 8;
        return incoming;
      },
      [&](const Outputs& out) {
        ASSERT_EQ(out.chosen.mode, Mode::kDisarmed);
        ASSERT_FALSE(commands_actuators(out));
        ASSERT_EQ(out.received.bus.identity.id, 1312u);
        ASSERT_TRUE(out.chosen.causes.has(safety::Cause::kWrongBus));
      });
}

TEST(Step, WithoutAFlagAnArmedCarNeverDrives) {
  const auto car = new_car();
  StandingCar source;
  source.mylaps_track = 0;
  bool stood_by = false;
  run(
      *car, seconds(5),
      [&](Instant now) {
        Received incoming = source.receive(now);
        incoming.requests.arm = now > kStart + seconds(2);
        return incoming;
      },
      [&](const Outputs& out) {
        stood_by = stood_by || out.chosen.mode == Mode::kStandby;
        ASSERT_NE(out.chosen.mode, Mode::kDriving);
        if (out.chosen.actuate) {
          ASSERT_EQ(out.chosen.command.throttle_fraction, 0.0);
        }
      });
  EXPECT_TRUE(stood_by) << "it held the brake and waited";
}

TEST(Step, UnderRedAnArmedCarNeverDrives) {
  const auto car = new_car();
  StandingCar source;
  source.mylaps_track = 1;
  run(
      *car, seconds(5),
      [&](Instant now) {
        Received incoming = source.receive(now);
        incoming.requests.arm = true;
        return incoming;
      },
      [&](const Outputs& out) { ASSERT_NE(out.chosen.mode, Mode::kDriving); });
}

TEST(Step, NoiseNeverMovesADisarmedCar) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const auto car = new_car();
    run(*car, seconds(60), noise(seed), [&](const Outputs& out) {
      ASSERT_EQ(out.chosen.mode, Mode::kDisarmed);
      ASSERT_FALSE(commands_actuators(out));
    });
    EXPECT_GT(car->inbound.refused.total(), 10'000u);
    EXPECT_GT(car->inbound.frames_applied, 1'000u) << "noise that is all refused tests little";
  }
}

// Requests are noise too: actuator frames leave in armed modes only, never with NaN behind them.
TEST(Step, WithNoiseAndRandomRequestsOnlyAnArmedCarCommandsActuators) {
  const auto car = new_car();
  Random random{7};
  StandingCar healthy;
  const ReceivedSource garbage = noise(8);
  safety::OperatorRequests requests;
  std::size_t armed = 0;
  run(
      *car, seconds(60),
      [&](Instant now) {
        Received incoming = healthy.receive(now);
        if (random.one_in(100)) {
          const Received bad = garbage(now);
          incoming.frames.insert(incoming.frames.end(), bad.frames.begin(), bad.frames.end());
          std::erase_if(incoming.frames, [](const can::ReceivedFrame& f) {
            return f.frame.id >= 1400 && f.frame.id < 1500;  // would bar arming for good
          });
        }
        if (random.one_in(50))
          requests = {.arm = !random.one_in(4),
                      .reset = random.one_in(2),
                      .stop = random.one_in(8),
                      .emergency_stop = random.one_in(16)};
        incoming.requests = requests;
        return incoming;
      },
      [&](const Outputs& out) {
        armed += out.chosen.mode != Mode::kDisarmed ? 1U : 0U;
        if (out.chosen.mode == Mode::kDisarmed) {
          ASSERT_FALSE(commands_actuators(out));
        }
        if (!out.chosen.actuate) return;
        ASSERT_TRUE(std::isfinite(out.chosen.command.road_wheel_rad));
        ASSERT_GE(out.chosen.command.throttle_fraction, 0.0);
        ASSERT_GE(out.chosen.command.brake_kpa, 0.0);
      });
  EXPECT_GT(armed, 100u);
}

// A sample may lie; the car is located with numbers or says that it is not, and after the lies it
// finds itself again.
TEST(Step, ItFindsItselfAgainAfterSenselessSamples) {
  const auto car = new_car();
  StandingCar healthy;
  Random random{21};
  std::size_t located = 0;
  Outputs last;
  run(
      *car, seconds(40),
      [&](Instant now) {
        Received incoming = healthy.receive(now);
        if (now < kStart + seconds(20) && random.one_in(4))
          testing::random_samples(random, now, incoming.sensors);
        return incoming;
      },
      [&](const Outputs& out) {
        last = out;
        if (!is_located(out.ego)) return;
        ++located;
        for (const double v : {out.ego.x_m, out.ego.y_m, out.ego.yaw_rad, out.ego.vx_mps,
                               out.ego.vy_mps, out.place.s_m, out.place.n_m})
          ASSERT_TRUE(std::isfinite(v)) << "tick " << car->ticks;
      });
  EXPECT_GT(located, 100u);
  EXPECT_EQ(last.ego.validity, world::Validity::kGood);
  EXPECT_NEAR(last.place.s_m, healthy.station_m, 0.5);
}

// ---- Planning at its own rate

TEST(Step, PlansAtItsOwnRate) {
  const auto car = new_car();
  StandingCar source;
  std::set<std::int64_t> planned;
  run(
      *car, seconds(2), [&](Instant now) { return source.receive(now); },
      [&](const Outputs&) { planned.insert(car->plan.at.ns); });
  EXPECT_EQ(planned.size(), 40u);
  EXPECT_EQ(car->ticks, 200u);
}

TEST(Step, PlansAtItsOwnRateWhereTicksComeEarlyAndLate) {
  const auto car = new_car();
  StandingCar source;
  Random random{7};
  std::vector<std::uint64_t> planned;
  Instant last{};
  for (std::uint64_t i = 0; i < 200; ++i) {
    // By a fifth of a tick: a live loop reads its clock when it has read its sockets.
    const auto late = microseconds(static_cast<std::int64_t>(random.below(2'000)));
    const Instant now = kStart + kTick * static_cast<std::int64_t>(i) + late;
    tick(*car, source.receive(now), now);
    if (car->plan.at != last) planned.push_back(i);
    last = car->plan.at;
  }
  ASSERT_EQ(planned.size(), 40u);
  for (std::size_t plan = 0; plan < planned.size(); ++plan) EXPECT_EQ(planned[plan], plan * 5);
}

TEST(Step, ReportsThePlaceOnTheTrack) {
  const auto car = new_car();
  StandingCar source;
  source.station_m = 1234.5;
  world::Curvilinear place;
  run(
      *car, seconds(2), [&](Instant now) { return source.receive(now); },
      [&](const Outputs& out) { place = out.place; });
  EXPECT_NEAR(place.s_m, 1234.5, 0.5);
  EXPECT_NEAR(place.n_m, 0.0, 0.2);
}

// LiDAR frames at 20 Hz, 20 ms old, of a car 20 m ahead and 3 m to the left. What is known then.
world::Opponents known_of_another(Car& car) {
  StandingCar source;
  source.station_m = 30.0;  // on a straight
  world::Opponents opponents;
  run(
      car, seconds(4),
      [&](Instant now) {
        Received received = source.receive(now);
        const bool due = now - kStart > seconds(2) && (now - kStart) / kTick % 5 == 0;
        if (!due) return received;
        world::DetectionFrame frame{.at = now - milliseconds(20), .received = now};
        (void)frame.detections.push({.confidence = 0.9, .x_m = 20.0, .y_m = 3.0, .yaw_rad = 0.0});
        received.detections = {frame};
        return received;
      },
      [&](const Outputs& out) { opponents = out.opponents; });
  return opponents;
}

TEST(Step, TracksAnotherCar) {
  const auto car = new_car();
  const world::Opponents opponents = known_of_another(*car);
  ASSERT_EQ(opponents.cars.size(), 1U);
  EXPECT_NEAR(opponents.cars[0].s_m, 50.0, 1.0);
  EXPECT_NEAR(opponents.cars[0].n_m, 3.0, 0.5);
  EXPECT_NEAR(opponents.cars[0].speed_mps, 0.0, 1.0);
  EXPECT_GT(car->tracking.counters.frames, 30U);
}

TEST(Step, DoesNotTrackBySensorsThatTheOperatorHasExcluded) {
  const auto car = new_car();
  car->orders.use.excluded = 1U << static_cast<unsigned>(world::Excludable::kLidar);
  EXPECT_EQ(known_of_another(*car).cars.size(), 0U);
  EXPECT_EQ(car->tracking.counters.frames, 0U);
  EXPECT_GT(car->tracking.counters.frames_excluded, 30U);
}

// ---- The state is a value

// Everything that a tick shows, as bits.
std::vector<std::uint64_t> bits_of(const Outputs& out, Instant now) {
  std::vector<std::uint64_t> bits;
  static const auto kNoCar = std::make_unique<Car>();
  const telemetry::Snapshot shown = map_telemetry(
      {.setup = setup(), .car = *kNoCar, .out = out, .log = {}, .io = {}, .now = now});
  for (const double v : shown.values.at)
    bits.push_back(std::isnan(v) ? 0 : std::bit_cast<std::uint64_t>(v));
  for (const can::Frame& f : out.passed.frames) {
    bits.push_back(f.id);
    for (const std::uint8_t byte : f.payload()) bits.push_back(byte);
  }
  for (const auto& verdict : out.located)
    bits.push_back(static_cast<std::uint64_t>(verdict.gate) << 8U | verdict.unit);
  for (const auto& row : out.watchdog.rows)
    bits.push_back(static_cast<std::uint64_t>(row.age.ns) << 3U |
                   static_cast<std::uint64_t>(row.health));
  bits.push_back(out.chosen.causes.bits());
  return bits;
}

std::vector<Received> mixed_inputs(std::size_t ticks) {
  StandingCar healthy;
  Random random{99};
  std::vector<Received> inputs;
  for (std::size_t i = 0; i < ticks; ++i) {
    const Instant now = kStart + kTick * static_cast<std::int64_t>(i);
    inputs.push_back(healthy.receive(now));
    inputs.back().requests.arm = i > 200;
    // Before it is armed, a car on a bus with unknown frames would not arm.
    const bool noisy = i > 250 && random.one_in(10);
    if (noisy) inputs.back().frames.push_back(testing::random_frame(random, now));
    std::erase_if(inputs.back().frames, [](const can::ReceivedFrame& f) {
      return f.frame.id >= 1400 && f.frame.id < 1500;
    });
    if (i > 400 && random.one_in(10)) testing::random_samples(random, now, inputs.back().sensors);
  }
  return inputs;
}

TEST(Step, ACopyGoesOnAsTheOriginal) {
  constexpr std::size_t kTicks = 600;
  const auto inputs = mixed_inputs(kTicks);
  const auto at = [](std::size_t i) { return kStart + kTick * static_cast<std::int64_t>(i); };
  const auto car = new_car();
  std::vector<std::vector<std::uint64_t>> stated;
  std::vector<std::unique_ptr<Car>> snapshots;
  bool drove = false;
  for (std::size_t i = 0; i < kTicks; ++i) {
    if (i % 150 == 0) {
      snapshots.push_back(new_car());
      std::memcpy(snapshots.back().get(), car.get(), sizeof(Car));
    }
    const Outputs out = tick(*car, inputs[i], at(i));
    drove = drove || out.chosen.mode == Mode::kDriving;
    stated.push_back(bits_of(out, at(i)));
  }
  EXPECT_TRUE(drove) << "a run in which the car only stands shows little";
  for (std::size_t s = 0; s < snapshots.size(); ++s)
    for (std::size_t i = s * 150; i < kTicks; ++i)
      ASSERT_EQ(bits_of(tick(*snapshots[s], inputs[i], at(i)), at(i)), stated[i])
          << "snapshot " << s << " tick " << i;
}

// ---- No heap

TEST(Step, TakesNothingFromTheHeap) {
  if (!pitwall::testing::kAllocationsCounted) GTEST_SKIP() << "not counted in this build";
  const auto inputs = mixed_inputs(500);
  const ReceivedSource garbage = noise(3);
  const auto car = new_car(), noisy = new_car();
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Instant now = kStart + kTick * static_cast<std::int64_t>(i);
    const Received bad = garbage(now);
    ASSERT_EQ(pitwall::testing::allocations_of([&] {
                step(setup(), *car, inputs[i].inputs(now));
                step(setup(), *noisy, bad.inputs(now));
              }),
              0u)
        << "tick " << i;
  }
  // The counter counts.
  EXPECT_GT(pitwall::testing::allocations_of([] { (void)std::vector<int>(10).size(); }) +
                pitwall::testing::allocations_of([] { (void)std::make_unique<Car>(); }),
            0u);
}

}  // namespace
}  // namespace pitwall::pipeline
