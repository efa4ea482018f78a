// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/tick_record.hpp"

#include <gtest/gtest.h>

namespace pitwall::recorder {
namespace {

TickCommand command(std::uint32_t id) {
  return {.id = id,
          .kind = static_cast<std::uint8_t>(id % 9),
          .argument = 0.1 * id,
          .expires_ns = -1'000 - std::int64_t{id}};
}

TEST(TickRecord, ComesBackWithItsCommandsToTheBit) {
  TickRecord tick;
  tick.number = 1'234'567;
  tick.dt_ns = 10'000'001;
  tick.frames_received = 7;
  tick.joystick_at_ns = kNever;
  tick.guardian_counters = 0xFEDC'BA98;
  tick.bus_load = 0.25;
  for (std::uint32_t id = 0; id < kTickCommandsMax; ++id) ASSERT_TRUE(append(tick, command(id)));
  EXPECT_FALSE(append(tick, command(99))) << "there is no room";
  TickBytes bytes;
  TickRecord back;
  ASSERT_TRUE(recording::from_cdr(recording::to_cdr(tick, bytes), back));
  EXPECT_EQ(back.number, 1'234'567U);
  EXPECT_EQ(back.dt_ns, 10'000'001);
  EXPECT_EQ(back.frames_received, 7U);
  EXPECT_EQ(back.joystick_at_ns, kNever);
  EXPECT_EQ(back.guardian_counters, 0xFEDC'BA98U);
  EXPECT_EQ(back.bus_load, 0.25);
  const auto commands = commands_of(back);
  ASSERT_TRUE(commands);
  ASSERT_EQ(commands->size(), kTickCommandsMax);
  for (std::uint32_t id = 0; id < kTickCommandsMax; ++id) {
    const TickCommand& had = commands->span()[id];
    EXPECT_EQ(had.id, id);
    EXPECT_EQ(had.kind, id % 9);
    EXPECT_EQ(had.argument, 0.1 * id);
    EXPECT_EQ(had.expires_ns, -1'000 - std::int64_t{id});
  }
}

TEST(TickRecord, CommandsThatAreCutGiveNone) {
  for (std::size_t bytes = 1; bytes < 2 * kTickCommandBytes; ++bytes) {
    TickRecord tick;
    for (std::size_t i = 0; i < bytes; ++i) ASSERT_TRUE(tick.commands.push(std::uint8_t{1}));
    EXPECT_EQ(commands_of(tick).has_value(), bytes % kTickCommandBytes == 0) << bytes;
  }
}

}  // namespace
}  // namespace pitwall::recorder
