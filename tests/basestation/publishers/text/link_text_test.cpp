// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/text/link_text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/basestation/radio_rig.hpp"

namespace pitwall::publishers {
namespace {

using telemetry::field;

std::string text_of(RadioRig& rig) {
  std::string text;
  for (const TextLine& line : link_lines(*rig.base, rig.now)) text += line.text + "\n";
  return text;
}

bool says(RadioRig& rig, const std::string& what) {
  return text_of(rig).find(what) != std::string::npos;
}

TEST(LinkText, AgesAreShortOrLong) {
  EXPECT_EQ(age_text(milliseconds(12)), "12 ms");
  EXPECT_EQ(age_text(seconds(31)), "31 s");
}

TEST(LinkText, SaysWhatIsNotKnownYet) {
  RadioRig rig;
  EXPECT_TRUE(says(rig, "link      nothing received")) << text_of(rig);
  EXPECT_TRUE(says(rig, "nothing received from the car"));
  EXPECT_TRUE(says(rig, "latched by the car: not received   authority: nobody"));
}

TEST(LinkText, HasOnePathOrTwo) {
  for (const std::uint8_t paths : {std::uint8_t{1}, std::uint8_t{2}}) {
    RadioRig rig({.paths = paths});
    rig.set(field("ego.x"), 1.0);
    rig.run(seconds(3));
    EXPECT_TRUE(says(rig, "path 0"));
    EXPECT_EQ(says(rig, "path 1"), paths == 2);
    EXPECT_EQ(says(rig, "copies by the other path"), paths == 2);
    EXPECT_TRUE(says(rig, "clocks known to +-")) << text_of(rig);
    EXPECT_TRUE(says(rig, "127.0.0.1:40001 proved")) << text_of(rig);
    EXPECT_TRUE(says(rig, "refused   0")) << text_of(rig);
  }
}

TEST(LinkText, SaysWhichEndSeesAnAttack) {
  RadioRig rig;
  rig.set(field("ego.x"), 1.0);
  rig.set(field("radio.threats"), 0.0);
  rig.run(seconds(2));
  EXPECT_FALSE(says(rig, "attack ")) << text_of(rig);
  rig.set(field("radio.threats"), 32.0);
  rig.run(seconds(1));
  EXPECT_TRUE(says(rig, "attack    seen by the car: Packets come a second time, from another"))
      << text_of(rig);
  const std::vector<std::uint8_t> noise(30, 0xFF);
  for (int i = 0; i < 200; ++i) rig.station->take(noise, 0, {.ip = 9, .port = 9}, rig.now);
  rig.run(milliseconds(200));
  EXPECT_TRUE(says(rig, "attack    seen by the base: Forged or foreign datagrams")) << text_of(rig);
  EXPECT_TRUE(says(rig, "ago   radio, seen by the base: Forged or foreign")) << text_of(rig);
  for (const TextLine& line : link_lines(*rig.base, rig.now)) {
    EXPECT_LE(line.text.size(), kScreenColumns) << line.text;
    EXPECT_EQ(line.tone == Tone::kAlarm, line.text.starts_with("attack")) << line.text;
  }
}

TEST(LinkText, FollowsACommandToItsFate) {
  RadioRig rig;
  rig.set(field("mode.stop_latch"), 0.0);
  rig.set(field("ego.x"), 1.0);
  rig.run(seconds(2));
  ASSERT_TRUE(rig.execute("take 4"));
  rig.run(milliseconds(100));
  ASSERT_TRUE(rig.execute("command speed_limit 30 because of a test"));
  EXPECT_TRUE(says(rig, "#1 speed limit 30 m/s: not sent for 0 ms")) << text_of(rig);
  rig.run(milliseconds(100));
  EXPECT_TRUE(says(rig, "speed limit 30 m/s: received by the car after ")) << text_of(rig);
  ASSERT_EQ(rig.reported.size(), 1U);
  rig.car->decide(rig.reported.front().id, telemetry::Outcome::kApplied, rig.now);
  rig.run(milliseconds(100));
  EXPECT_TRUE(says(rig, "speed limit 30 m/s: applied after ")) << text_of(rig);
  EXPECT_TRUE(says(rig, "authority: console 4"));
}

TEST(LinkText, SaysWhatTheOperatorWasRefused) {
  RadioRig rig;
  ASSERT_FALSE(rig.execute("fly away"));
  EXPECT_TRUE(says(rig, "operator  script: fly away: refused: not one of stop,")) << text_of(rig);
}

}  // namespace
}  // namespace pitwall::publishers
