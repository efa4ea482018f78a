// SPDX-License-Identifier: Apache-2.0
#include "basestation/inputs/joystick_device.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

#include "protocol/transport/readiness.hpp"
#include "tests/basestation/radio_rig.hpp"
#include "tests/support/input_events.hpp"

namespace pitwall::inputs {
namespace {

using pitwall::testing::InputBytes;

// A device at the other end of a pipe, and a car that hears the hand over the radio.
struct Bench {
  RadioRig rig;
  transport::FileDescriptor hand;
  std::optional<JoystickDevice> feed;

  Bench() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_NONBLOCK | O_CLOEXEC), 0);
    hand = transport::FileDescriptor{ends[1]};
    feed.emplace(JoystickDevice::of(transport::FileDescriptor{ends[0]}, {}));
    rig.set(telemetry::fields_of(telemetry::Group::kEgo).first, 1.0);
    rig.run(seconds(2));
  }
  void say(const InputBytes& bytes) {
    ASSERT_EQ(::write(hand.get(), bytes.bytes.data(), bytes.bytes.size()),
              static_cast<ssize_t>(bytes.bytes.size()));
  }
  void run(Duration length) {
    for (const Instant end = rig.now + length; rig.now < end;) {
      feed->read(rig.now, [&](const telemetry::JoystickSample& sample, Instant at) {
        rig.base->requests().steer(sample, {.console = 4, .name = "joystick"}, at);
      });
      rig.run(milliseconds(1));
    }
  }
  // A hand that speaks at 50 Hz for so long.
  void hold(Duration length) {
    for (const Instant end = rig.now + length; rig.now < end;) {
      say(InputBytes{}.key(310, 1).axis(2, 255).axis(5, 51).report());
      run(milliseconds(20));
    }
  }
  auto received() const { return rig.car->view(rig.now).joystick; }
};

TEST(JoystickDevice, TheCarHearsTheHandAndNothingElse) {
  Bench bench;
  EXPECT_FALSE(bench.received());
  bench.hold(seconds(1));
  const auto sample = bench.received();
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->throttle_cap, 0.0, 0.01);
  EXPECT_NEAR(sample->brake, 0.2, 0.01);
}

// Lost is the hand that is meant to speak and does not, and the device that is gone.
TEST(JoystickDevice, AHandThatLetsGoIsNotLostOneThatFreezesIs) {
  Bench bench;
  EXPECT_FALSE(bench.feed->lost(bench.rig.now));
  bench.hold(seconds(1));
  EXPECT_FALSE(bench.feed->lost(bench.rig.now));
  bench.run(telemetry::kJoystickDead + milliseconds(30));
  EXPECT_TRUE(bench.feed->lost(bench.rig.now));
  bench.hold(milliseconds(100));
  EXPECT_FALSE(bench.feed->lost(bench.rig.now));
  bench.say(InputBytes{}.key(310, 0).report());
  bench.run(seconds(1));
  EXPECT_FALSE(bench.feed->lost(bench.rig.now));
  bench.hand = {};
  bench.run(milliseconds(10));
  EXPECT_TRUE(bench.feed->lost(bench.rig.now));
}

TEST(JoystickDevice, AHandThatFreezesIsDeadAfter200Milliseconds) {
  Bench bench;
  bench.hold(seconds(1));
  ASSERT_TRUE(bench.received());
  bench.run(telemetry::kJoystickDead + milliseconds(1));
  EXPECT_FALSE(bench.received());
}

TEST(JoystickDevice, APulledPlugIsDeadAfter200MillisecondsAndKeepsNobodyBusy) {
  Bench bench;
  bench.hold(seconds(1));
  bench.hand.reset();
  bench.run(telemetry::kJoystickDead + milliseconds(1));
  EXPECT_FALSE(bench.received());
  EXPECT_FALSE(bench.feed->present());
  const std::array<int, 1> watched{bench.feed->fd()};
  EXPECT_EQ(transport::wait_readable(watched, Instant{}), 0U);
}

TEST(JoystickDevice, AKeyLetGoIsDeadAfter200MillisecondsThoughTheStickMoves) {
  Bench bench;
  bench.hold(seconds(1));
  for (int i = 0; i < 11; ++i) {
    bench.say(InputBytes{}.key(310, 0).axis(2, 100 + i).report());
    bench.run(milliseconds(20));
  }
  EXPECT_FALSE(bench.received());
}

TEST(JoystickDevice, ADeviceThatIsNotThereIsToldWithItsPath) {
  const auto feed = JoystickDevice::open("/dev/input/none", {});
  ASSERT_FALSE(feed);
  EXPECT_EQ(feed.error().place, "/dev/input/none");
}

}  // namespace
}  // namespace pitwall::inputs
