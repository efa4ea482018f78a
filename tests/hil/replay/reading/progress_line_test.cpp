// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/reading/progress_line.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <vector>

namespace pitwall::replay {
namespace {

TEST(ProgressText, PerCentSizeAndTimeLeft) {
  constexpr std::size_t kGiB = std::size_t{1} << 30;
  EXPECT_EQ(progress_text("reading a.log", kGiB / 2, 2 * kGiB, seconds(4)),
            "reading a.log: 25 % of 2.0 GiB, 12 s left");
  EXPECT_EQ(progress_text("x", 0, kGiB / 2, seconds(4)), "x: 0 % of 512.0 MiB");
  EXPECT_EQ(progress_text("x", 0, 0, seconds(4)), "x: 100 % of 0.0 MiB, 0 s left");
  EXPECT_EQ(progress_text("x", 2 * kGiB, kGiB, seconds(4)), "x: 100 % of 1.0 GiB, 0 s left");
}

TEST(ProgressPace, SilentAtFirstAndThenNoMoreOftenThanItsPause) {
  ProgressPace pace{milliseconds(500), milliseconds(250)};
  std::vector<std::int64_t> due;
  for (std::int64_t ms = 0; ms < 1'200; ms += 10)
    if (pace.is_due(milliseconds(ms))) due.push_back(ms);
  EXPECT_EQ(due, (std::vector<std::int64_t>{500, 750, 1'000}));
}

TEST(ProgressLine, WithoutATerminalItIsShownOnlyWhereItWasAskedFor) {
  testing::internal::CaptureStderr();
  {
    Instant now{};
    const auto clock = [&] { return now; };
    ProgressLine quiet("reading", false, clock);
    EXPECT_FALSE(quiet.function());
    ProgressLine loud("reading", true, clock);
    for (std::size_t i = 1; i <= 3; ++i, now = now + milliseconds(600)) loud.function()(i, 4);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "reading: 25 % of 0.0 MiB, 0 s left\nreading: 75 % of 0.0 MiB, 0 s left\n");
}

// Standard error is a terminal of our own for a while.
TEST(ProgressLine, OnATerminalOneLineIsWrittenOverAndClearedAtTheEnd) {
  int own = -1, terminal = -1;
  ASSERT_EQ(::openpty(&own, &terminal, nullptr, nullptr, nullptr), 0);
  const int kept = ::dup(2);
  ::dup2(terminal, 2);
  {
    Instant now{};
    ProgressLine line("reading", false, [&] { return now; });
    const auto show = line.function();
    EXPECT_TRUE(show);
    if (show) {
      show(1, 4);  // too early
      now = now + milliseconds(600);
      show(2, 4);
      now = now + milliseconds(200);
      show(3, 4);  // too soon behind the other one
    }
  }
  ::dup2(kept, 2);
  ::close(kept);
  ::close(terminal);
  std::array<char, 512> bytes{};
  std::string shown;  // a terminal may hand over what was written in parts
  for (ssize_t count = 0; (count = ::read(own, bytes.data(), bytes.size())) > 0;)
    shown.append(bytes.data(), static_cast<std::size_t>(count));
  ::close(own);
  EXPECT_EQ(shown, "\r\x1B[Kreading: 50 % of 0.0 MiB, 1 s left\r\x1B[K");
}

}  // namespace
}  // namespace pitwall::replay
