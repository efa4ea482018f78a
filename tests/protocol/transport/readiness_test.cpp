// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/readiness.hpp"

#include <gtest/gtest.h>

#include <array>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/stream/serial_line.hpp"

namespace pitwall::transport {
namespace {

TEST(Readiness, SaysWhichAndWaitsForTheDeadlineOtherwise) {
  auto quiet = stream_pair();
  auto busy = stream_pair();
  ASSERT_TRUE(quiet && busy);
  const std::array watched{quiet->first.get(), -1, busy->first.get()};
  const Instant deadline = monotonic_now() + milliseconds(20);
  EXPECT_EQ(wait_readable(watched, deadline), 0U);
  EXPECT_GE(monotonic_now(), deadline);
  ASSERT_TRUE(write_to(busy->second.get(), "abc"));
  EXPECT_EQ(wait_readable(watched, monotonic_now() + seconds(5)), 0b100U);
  quiet->second.reset();  // its end is something to read, too
  EXPECT_EQ(wait_readable(watched, monotonic_now() + seconds(5)), 0b101U);
}

TEST(Readiness, NeverWaitsLongerThanItIsToldToHoweverFarTheDeadline) {
  auto quiet = stream_pair();
  ASSERT_TRUE(quiet);
  const std::array watched{quiet->first.get()};
  const Instant start = monotonic_now();
  EXPECT_EQ(wait_readable(watched, Instant::max(), milliseconds(20)), 0U);
  EXPECT_GE(monotonic_now() - start, milliseconds(20));
  EXPECT_EQ(wait_readable(watched, start + milliseconds(60), seconds(60)), 0U);
  EXPECT_GE(monotonic_now() - start, milliseconds(60));
  EXPECT_LT(monotonic_now() - start, seconds(30));
}

TEST(Readiness, ReadsWhatIsThereAndKnowsTheEnd) {
  auto pair = stream_pair();
  ASSERT_TRUE(pair.has_value());
  std::array<std::uint8_t, 2> two{};
  EXPECT_EQ(read_available(pair->first.get(), two).bytes, 0U);
  ASSERT_TRUE(write_to(pair->second.get(), "abc"));
  EXPECT_EQ(read_available(pair->first.get(), two).bytes, 2U);
  EXPECT_EQ(two[1], 'b');
  pair->second.reset();
  const auto rest = read_available(pair->first.get(), two);
  EXPECT_EQ(rest.bytes, 1U);
  EXPECT_FALSE(rest.ended);
  EXPECT_TRUE(read_available(pair->first.get(), two).ended);
}

}  // namespace
}  // namespace pitwall::transport
