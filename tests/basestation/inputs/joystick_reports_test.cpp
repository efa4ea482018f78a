// SPDX-License-Identifier: Apache-2.0
#include "basestation/inputs/joystick_reports.hpp"

#include <gtest/gtest.h>
#include <linux/input.h>

#include "tests/support/input_events.hpp"

namespace pitwall::inputs {
namespace {

using testing::InputBytes;

const JoystickMapping kMapping = *JoystickMapping::parse("lift=2:0:200,brake=5:1000:0,enable=310");

InputBytes held() { return InputBytes{}.key(310, 1).axis(2, 50).axis(5, 750).report(); }

TEST(JoystickReports, AReportWithTheKeyHeldIsASampleInTheCalibratedRange) {
  JoystickReports reports{kMapping};
  const auto sample = reports.feed(held().bytes);
  ASSERT_TRUE(sample);
  EXPECT_DOUBLE_EQ(sample->throttle_cap, 0.75);
  EXPECT_DOUBLE_EQ(sample->brake, 0.25);  // an axis that falls when it is pressed
}

TEST(JoystickReports, BytesInPiecesOfAnySizeSayTheSame) {
  const auto bytes = held().axis(2, 100).report().axis(5, 0).report().bytes;
  for (std::size_t size = 1; size < bytes.size(); ++size) {
    JoystickReports reports{kMapping};
    for (std::size_t at = 0; at < bytes.size(); at += size) {
      reports.feed(std::span{bytes}.subspan(at, std::min(size, bytes.size() - at)));
    }
    EXPECT_EQ(reports.counters().samples, 3U) << size;
  }
}

TEST(JoystickReports, WithoutTheKeyOrBeforeBothAxesNothingIsSaid) {
  JoystickReports reports{kMapping};
  EXPECT_FALSE(reports.feed(InputBytes{}.axis(2, 0).axis(5, 0).report().bytes));
  EXPECT_EQ(reports.counters().not_enabled, 1U);
  reports.forget();
  EXPECT_FALSE(reports.feed(InputBytes{}.key(310, 1).axis(2, 0).report().bytes));
  EXPECT_EQ(reports.counters().unknown_axis, 1U);
  EXPECT_TRUE(reports.feed(InputBytes{}.axis(5, 0).report().bytes));
  EXPECT_FALSE(reports.feed(InputBytes{}.key(310, 0).report().bytes));
}

TEST(JoystickReports, NothingIsSaidWithoutAReport) {
  JoystickReports reports{kMapping};
  ASSERT_TRUE(reports.feed(held().bytes));
  EXPECT_FALSE(reports.feed({}));
  EXPECT_FALSE(reports.feed(InputBytes{}.axis(2, 10).bytes));
}

TEST(JoystickReports, AKeyThatIsLetGoInTheSameBytesEndsTheSample) {
  JoystickReports reports{kMapping};
  EXPECT_FALSE(reports.feed(held().key(310, 0).report().bytes));
}

TEST(JoystickReports, AValueThatIsNoneOfTheRangeIsNoSample) {
  JoystickReports reports{kMapping};
  ASSERT_TRUE(reports.feed(held().bytes));
  for (const std::int32_t wrong : {-21, 221, INT32_MAX, INT32_MIN}) {
    EXPECT_FALSE(reports.feed(InputBytes{}.axis(2, wrong).report().bytes)) << wrong;
  }
  EXPECT_EQ(reports.counters().out_of_range, 4U);
  const auto end = reports.feed(InputBytes{}.axis(2, 219).report().bytes);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->throttle_cap, 0.0);
}

TEST(JoystickReports, AfterLostEventsEverythingMustBeSaidAnew) {
  JoystickReports reports{kMapping};
  ASSERT_TRUE(reports.feed(held().bytes));
  EXPECT_FALSE(reports.feed(InputBytes{}.dropped().axis(2, 0).axis(5, 0).report().bytes));
  EXPECT_FALSE(reports.feed(InputBytes{}.axis(2, 0).axis(5, 0).report().bytes));
  EXPECT_FALSE(reports.enabled());
  EXPECT_TRUE(reports.feed(held().bytes));
  EXPECT_EQ(reports.counters().lost_events, 1U);
}

TEST(JoystickMapping, MistakesAreToldWithTheirEntry) {
  for (const char* wrong :
       {"lift", "lift=1", "lift=1:2", "lift=1:5:5", "brake=64:0:1", "wheel=1:0:1", "enable=0",
        "enable=a", "enable=99999", "lift=5:0:1", "lift=1:0:1x"}) {
    EXPECT_FALSE(JoystickMapping::parse(wrong)) << wrong;
  }
  EXPECT_EQ(to_string(JoystickMapping::parse("enable=0").error()),
            "joystick: enable=0: error: no such key");
  EXPECT_TRUE(JoystickMapping::parse(""));
}

}  // namespace
}  // namespace pitwall::inputs
