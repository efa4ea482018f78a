// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/sensor_arrival.hpp"

#include <gtest/gtest.h>

namespace pitwall::benchmarks {
namespace {

constexpr Instant kBegin{seconds(77).ns};
constexpr UtcTime kZero{kNanosecondsPerSecond * 1'700'000'000};
constexpr unsigned kPasses = 3;
constexpr std::int64_t kFrames = 40;

// A frame every 2 ms; a datagram of each receiver every 8 ms, 1 ms after a frame.
class SensorArrivals : public ::testing::Test {
 protected:
  SensorArrivals() {
    for (std::int64_t i = 0; i < kFrames; ++i) {
      replay::LoggedFrame logged{.at = at(milliseconds(2) * i), .frame = {}};
      logged.frame.id = static_cast<std::uint32_t>(i);
      log.push_back(logged);
    }
    for (std::int64_t i = 0; i < kFrames; i += 2) {
      const std::size_t receiver = i / 2 % 2 == 0 ? 0 : 1;
      sent.push_back(
          {at(milliseconds(2) * i + milliseconds(1)), receiver, {static_cast<std::uint8_t>(i), 7}});
    }
    for (unsigned pass = 0; pass < kPasses; ++pass) {
      const Instant begin = kBegin + kPass * std::int64_t{pass};
      for (const auto& logged : log)
        frames.push_back({logged.frame, begin + Duration{logged.at.ns - kZero.ns}});
      for (const auto& datagram : sent)
        datagrams[datagram.receiver].push_back(
            {begin + Duration{datagram.at.ns - kZero.ns}, datagram.bytes});
    }
  }

  static UtcTime at(Duration since) { return {kZero.ns + since.ns}; }
  SensorArrival result() const {
    return compare({.frames = log, .datagrams = sent, .pass = kPass, .passes = kPasses}, frames,
                   datagrams);
  }

  static constexpr Duration kPass = milliseconds(80);
  std::vector<replay::LoggedFrame> log;
  std::vector<SensorDatagram> sent;
  std::vector<can::ReceivedFrame> frames;
  ReceivedDatagrams datagrams;
};

TEST_F(SensorArrivals, AllOfAllPassesInTheirOrderIsWhole) {
  const SensorArrival arrival = result();
  EXPECT_TRUE(arrival.is_whole());
  EXPECT_TRUE(arrival.order_is_kept());
  EXPECT_EQ(arrival.frames.wanted, kPasses * std::uint64_t{kFrames});
  EXPECT_EQ(arrival.receivers[0].wanted + arrival.receivers[1].wanted, kPasses * sent.size());
  ASSERT_TRUE(arrival.order);
  EXPECT_EQ(arrival.order->changes, 2 * kPasses * sent.size());
  EXPECT_EQ(arrival.order->shown, arrival.order->changes);
  ASSERT_TRUE(arrival.frames.timing);
  EXPECT_EQ(arrival.frames.timing->lateness.max_us, 0.0) << "the seams included";
}

TEST_F(SensorArrivals, APassThatIsMissingIsLost) {
  frames.resize(2 * kFrames);
  datagrams[1].resize(2 * datagrams[1].size() / 3);
  const SensorArrival arrival = result();
  EXPECT_EQ(arrival.frames.lost, std::uint64_t{kFrames});
  EXPECT_TRUE(arrival.receivers[0].is_whole());
  EXPECT_EQ(arrival.receivers[1].lost, sent.size() / 2);
  EXPECT_FALSE(arrival.is_whole());
  EXPECT_FALSE(arrival.order_is_kept());
}

TEST_F(SensorArrivals, ADatagramThatIsChangedTwiceThereOrMovedIsSeen) {
  datagrams[0][3].bytes[1] = 8;
  datagrams[1].push_back(datagrams[1].back());
  SensorArrival arrival = result();
  EXPECT_EQ(arrival.receivers[0].lost, 1U);
  EXPECT_EQ(arrival.receivers[0].extra, 1U);
  EXPECT_EQ(arrival.receivers[1].extra, 1U);
  EXPECT_FALSE(arrival.is_whole());
  datagrams[0][3].bytes[1] = 7;
  datagrams[1].pop_back();
  std::swap(datagrams[0][3].bytes, datagrams[0][4].bytes);
  arrival = result();
  EXPECT_EQ(arrival.receivers[0].lost + arrival.receivers[0].extra, 0U);
  EXPECT_FALSE(arrival.receivers[0].in_order);
  EXPECT_FALSE(arrival.is_whole());
}

TEST_F(SensorArrivals, AFrameBehindADatagramThatIsDueLaterBreaksTheOrder) {
  // Frame 2 is due at 4 ms, the datagram behind it at 5 ms.
  frames[2].at = kBegin + milliseconds(5);
  EXPECT_TRUE(result().order_is_kept()) << "not to be told";
  frames[2].at = frames[2].at + Duration{1};
  SensorArrival arrival = result();
  EXPECT_TRUE(arrival.is_whole()) << "each track is in order";
  ASSERT_TRUE(arrival.order);
  EXPECT_EQ(arrival.order->broken, 1U);
  EXPECT_FALSE(arrival.order_is_kept());
}

TEST_F(SensorArrivals, ADatagramOfTheNextPassBeforeTheLastFrameBreaksTheOrder) {
  // The seam: the first datagram of the second pass is sent 5 ms early.
  datagrams[0][datagrams[0].size() / kPasses].at = kBegin + kPass - milliseconds(4);
  const SensorArrival arrival = result();
  ASSERT_TRUE(arrival.order);
  EXPECT_EQ(arrival.order->broken, 3U) << "of the first pass a datagram and a frame, then a frame";
}

TEST_F(SensorArrivals, WhatIsDueWithinAGroupMayChangePlaces) {
  sent[0].at = at(microseconds(10));  // frame 0 is due at zero
  for (unsigned pass = 0; pass < kPasses; ++pass) {
    const Instant begin = kBegin + kPass * std::int64_t{pass};
    datagrams[0][pass * sent.size() / 2].at = begin;
    frames[pass * static_cast<unsigned>(kFrames)].at = begin + microseconds(20);
  }
  EXPECT_TRUE(result().order_is_kept());
}

TEST_F(SensorArrivals, WhereNothingIsShownNothingIsKept) {
  for (auto& frame : frames) frame.at = kBegin;
  for (auto& receiver : datagrams)
    for (auto& datagram : receiver) datagram.at = kBegin;
  const SensorArrival arrival = result();
  ASSERT_TRUE(arrival.order);
  EXPECT_EQ(arrival.order->broken, 0U);
  EXPECT_EQ(arrival.order->shown, 0U);
  EXPECT_FALSE(arrival.order_is_kept());
}

}  // namespace
}  // namespace pitwall::benchmarks
