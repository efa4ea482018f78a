// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/text/terminal.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "tests/basestation/radio_rig.hpp"

namespace pitwall::publishers {
namespace {

class Terminal : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_NE(file_, nullptr); }
  void TearDown() override {
    if (file_ != nullptr) std::fclose(file_);
  }
  std::string contents() {
    std::rewind(file_);
    std::string text;
    for (int c = std::fgetc(file_); c != EOF; c = std::fgetc(file_)) text += static_cast<char>(c);
    return text;
  }
  static std::size_t count(std::string_view text, std::string_view what) {
    std::size_t times = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string_view::npos; ++at) ++times;
    return times;
  }

  RadioRig rig_;
  std::FILE* file_ = std::tmpfile();
};

TEST_F(Terminal, ShowsTheCarAsOftenAsItIsAskedTo) {
  rig_.set(telemetry::field("ego.x"), 12.0);
  rig_.run(seconds(2));
  Screen screen{{{.service = rig_.base.get(), .title = "CAR 7"}}, {.plain = true}, file_};
  for (int turn = 0; turn < 100; ++turn) {
    screen.serve(rig_.now);
    rig_.now += milliseconds(10);
  }
  const std::string screens = contents();
  EXPECT_EQ(count(screens, "REAL CAR"), 10U);
  EXPECT_NE(screens.find("x: 12.0"), std::string::npos);
  EXPECT_EQ(screens.find('\x1b'), std::string::npos);
  EXPECT_EQ(screens.find("CAR 7\n"), std::string::npos) << "there is one car only";
}

TEST_F(Terminal, SeveralCarsStandBelowEachOtherOnOneScreen) {
  RadioRig other;
  Screen screen{{{.service = rig_.base.get(), .title = "CAR 7"},
                 {.service = other.base.get(), .title = "CAR 8"}},
                {},
                file_};
  screen.finish(rig_.now);
  const std::string text = contents();
  EXPECT_EQ(count(text, "CAR 7"), 1U);
  EXPECT_EQ(count(text, "CAR 8"), 1U);
  EXPECT_EQ(count(text, "\x1b[H"), 1U) << "the cursor goes home once for both";
  EXPECT_LT(text.find("CAR 7"), text.find("CAR 8"));
}

// A flood is one line.
TEST_F(Terminal, AttacksAreALineOfTheLog) {
  StationLog log{{{.service = rig_.base.get(), .title = "car 7"}}, file_};
  const std::vector<std::uint8_t> noise(30, 0xFF);
  for (int i = 0; i < 150; ++i) {
    rig_.base->receive(noise, 0, RadioRig::kCarAt, rig_.now);
    rig_.run(milliseconds(1));
    log.serve(rig_.now);
  }
  rig_.run(milliseconds(200));
  log.serve(rig_.now);
  EXPECT_EQ(contents(),
            "pitwall-base: car 7: radio, seen by the base: Forged or foreign datagrams come at "
            "rate; all are refused\n");
}

TEST_F(Terminal, ARefusedRequestIsALineOfTheLog) {
  StationLog log{{{.service = rig_.base.get(), .title = "car 7"}}, file_};
  ASSERT_TRUE(rig_.execute("take 3"));
  ASSERT_FALSE(rig_.execute("fly away"));
  log.serve(rig_.now);
  log.serve(rig_.now);
  const std::string text = contents();
  EXPECT_EQ(text.find("pitwall-base: car 7: script: fly away: refused: not one of stop, "), 0U)
      << text;
  EXPECT_EQ(count(text, "\n"), 1U);
}

}  // namespace
}  // namespace pitwall::publishers
