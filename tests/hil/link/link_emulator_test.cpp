// SPDX-License-Identifier: Apache-2.0
#include "hil/link/link_emulator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hil/link/trace.hpp"

namespace pitwall::link {
namespace {

constexpr std::size_t kOverhead = 28;  // IPv4 and UDP without options

struct Sent {
  Instant at{};
  bool arrived = false;
  Instant arrives{};
};

// Datagrams of `size` bytes each `period`; which of them came through.
std::vector<Sent> send_evenly(LinkEmulator& link, Duration period, Duration length,
                              std::size_t size) {
  std::vector<Sent> sent;
  const std::vector<std::uint8_t> bytes(size, 0x5A);
  const auto collect = [&](Instant until) {
    while (const auto datagram = link.take(until)) {
      sent[datagram->tag].arrived = true;
      sent[datagram->tag].arrives = datagram->arrives;
    }
  };
  for (Instant at{}; at < Instant{} + length; at += period) {
    sent.push_back({at});
    link.offer(bytes, at, sent.size() - 1);
    collect(at);
  }
  collect(Instant::max());
  return sent;
}

double share_lost(const std::vector<Sent>& sent) {
  const auto lost = std::ranges::count(sent, false, &Sent::arrived);
  return static_cast<double>(lost) / static_cast<double>(sent.size());
}

double mean_burst_ms(const std::vector<Sent>& sent, Duration period) {
  double lost = 0.0, bursts = 0.0;
  bool before = true;
  for (const Sent& s : sent) {
    lost += s.arrived ? 0.0 : 1.0;
    bursts += !s.arrived && before ? 1.0 : 0.0;
    before = s.arrived;
  }
  return lost * period.milliseconds() / bursts;
}

TEST(LinkEmulator, LosesTheShareInBurstsOfTheLengthThatWereAskedFor) {
  struct Case {
    double loss;
    Duration fade;
  };
  for (const Case c : {Case{0.3, milliseconds(50)}, Case{0.3, milliseconds(120)},
                       Case{0.5, milliseconds(120)}, Case{0.1, milliseconds(120)}}) {
    LinkEmulator link(bursty(c.loss, c.fade, 0.0, milliseconds(15)), 7);
    const Duration period = c.fade / 40;
    const auto sent = send_evenly(link, period, c.fade * 20'000, 32);
    EXPECT_NEAR(share_lost(sent), c.loss, 0.01);
    EXPECT_NEAR(mean_burst_ms(sent, period), c.fade.milliseconds(), 0.05 * c.fade.milliseconds());
  }
}

TEST(LinkEmulator, LosesSomeInGoodTimesAndKeepsSomeInFades) {
  LinkParams params;
  params.fades = {milliseconds(280), milliseconds(120), 0.05, 0.8};
  LinkEmulator link(params, 19);
  const auto sent = send_evenly(link, milliseconds(10), seconds(3'600), 32);
  EXPECT_NEAR(share_lost(sent), 0.7 * 0.05 + 0.3 * 0.8, 0.01);
  const auto count = static_cast<double>(sent.size());
  EXPECT_NEAR(static_cast<double>(link.counters().lost) / count, 0.7 * 0.05, 0.005);
  EXPECT_NEAR(static_cast<double>(link.counters().faded) / count, 0.3 * 0.8, 0.01);
}

TEST(LinkEmulator, ReplaysARecordingAgainAndAgainWithTheLossItHolds) {
  LinkParams params;
  params.trace.outages = {{Instant{} + seconds(1), Instant{} + seconds(3), 0.25}};
  params.trace.repeat = seconds(10);
  LinkEmulator link(params, 23);
  double inside = 0.0, lost = 0.0;
  for (const Sent& s : send_evenly(link, milliseconds(5), seconds(1'000), 32)) {
    const double in_turn = std::fmod(Duration{s.at.ns}.seconds(), 10.0);
    if (in_turn < 1.0 || in_turn >= 3.0) {
      ASSERT_TRUE(s.arrived);
      continue;
    }
    inside += 1.0;
    lost += s.arrived ? 0.0 : 1.0;
  }
  EXPECT_NEAR(lost / inside, 0.25, 0.01);
}

TEST(LinkEmulator, IndependentLossHitsEachDatagramAlike) {
  LinkParams params;
  params.loss = 0.3;
  LinkEmulator link(params, 3);
  const auto sent = send_evenly(link, milliseconds(10), seconds(3'600), 32);
  EXPECT_NEAR(share_lost(sent), 0.3, 0.01);
  EXPECT_NEAR(mean_burst_ms(sent, milliseconds(10)), 10.0 / 0.7, 0.05 * 10.0 / 0.7);
}

TEST(LinkEmulator, DelaysByWhatWasAskedForPlusTheTimeOnTheAir) {
  for (const Duration jitter : {Duration{}, milliseconds(4)}) {
    LinkParams params = bursty(0.3, milliseconds(120), 32'000.0, milliseconds(15));
    params.jitter = jitter;
    LinkEmulator link(params, 11);
    const std::size_t size = 148;
    const auto sent = send_evenly(link, milliseconds(20), seconds(600), size);
    double sum_ms = 0.0, arrived = 0.0;
    for (const Sent& s : sent) {
      if (!s.arrived) continue;
      sum_ms += (s.arrives - s.at).milliseconds();
      arrived += 1.0;
    }
    const double air_ms = static_cast<double>(size + kOverhead) / 32'000.0 * 1e3;
    EXPECT_NEAR(sum_ms / arrived, 15.0 + air_ms + jitter.milliseconds() / 2, 0.3);
  }
}

TEST(LinkEmulator, SendersOfOneSeedMeetTheSameFades) {
  const Fades fades = bursty(0.3, milliseconds(120), 0.0, {}).fades;
  const LinkTrace trace = trace_of(fades, 42, seconds(300));
  LinkParams params;
  params.fades = fades;
  struct Sender {
    Duration period;
    std::size_t size;
  };
  for (const Sender sender : {Sender{milliseconds(20), 148}, Sender{microseconds(3'001), 900}}) {
    LinkEmulator link(params, 42);
    const auto sent = send_evenly(link, sender.period, seconds(300), sender.size);
    for (const Sent& s : sent) ASSERT_EQ(s.arrived, loss_over_time(trace, s.at) == 0.0);
  }
  EXPECT_NE(trace_of(fades, 43, seconds(300)).outages.front().to, trace.outages.front().to);
}

TEST(LinkEmulator, ADatagramFadesWhileItIsOnTheAirNotWhileItWaits) {
  LinkParams params;
  params.rate_bytes_per_s = 1'000.0;
  params.trace.outages = {{Instant{} + milliseconds(150), Instant{} + milliseconds(250), 1.0}};
  LinkEmulator link(params, 1);
  const std::vector<std::uint8_t> bytes(100 - kOverhead);  // 100 ms on the air
  for (std::uint64_t i = 0; i < 4; ++i) link.offer(bytes, Instant{}, i);
  std::vector<std::uint64_t> came;
  while (const auto datagram = link.take(Instant::max())) came.push_back(datagram->tag);
  EXPECT_EQ(came, (std::vector<std::uint64_t>{0, 2, 3}));
  EXPECT_EQ(link.counters().faded, 1U);
}

TEST(LinkEmulator, TheQueueIsBoundedAndTheAirIsSerial) {
  LinkParams params;
  params.rate_bytes_per_s = 32'000.0;
  params.queue_bytes = 16'000;
  params.delay = milliseconds(15);
  LinkEmulator link(params, 1);
  const auto sent = send_evenly(link, milliseconds(5), seconds(60), 480 - kOverhead);  // 3x
  EXPECT_NEAR(share_lost(sent), 2.0 / 3.0, 0.01);
  EXPECT_EQ(link.counters().queue_full,
            static_cast<std::uint64_t>(std::ranges::count(sent, false, &Sent::arrived)));
  Duration longest{};
  std::vector<Instant> arrivals;
  for (const Sent& s : sent) {
    if (!s.arrived) continue;
    longest = std::max(longest, s.arrives - s.at);
    arrivals.push_back(s.arrives);
  }
  EXPECT_NEAR(longest.milliseconds(), 15.0 + 500.0, 16.0);  // a whole queue, less than a datagram
  for (std::size_t i = 1; i < arrivals.size(); ++i)
    ASSERT_GE(arrivals[i] - arrivals[i - 1], milliseconds(15) - nanoseconds(1));  // 480 B
}

// No effect moves the draws of another: the same datagrams are lost, duplicated, spoiled.
TEST(LinkEmulator, EachEffectHasItsOwnStream) {
  LinkParams plain = bursty(0.3, milliseconds(120), 0.0, milliseconds(15));
  plain.loss = 0.05;
  LinkParams all = plain;
  all.jitter = milliseconds(3);
  all.duplicate = 0.1;
  all.corrupt = 0.1;
  all.reorder = 0.1;
  all.reorder_by = milliseconds(50);
  LinkEmulator a(plain, 5), b(all, 5);
  const auto sent_a = send_evenly(a, milliseconds(20), seconds(600), 64);
  const auto sent_b = send_evenly(b, milliseconds(20), seconds(600), 64);
  ASSERT_EQ(sent_a.size(), sent_b.size());
  for (std::size_t i = 0; i < sent_a.size(); ++i)
    ASSERT_EQ(sent_a[i].arrived, sent_b[i].arrived) << i;
}

TEST(LinkEmulator, EveryDatagramIsAccountedFor) {
  LinkParams params = bursty(0.3, milliseconds(120), 32'000.0, milliseconds(15));
  params.fades.loss_good = 0.02;
  params.loss = 0.02;
  params.duplicate = 0.05;
  params.corrupt = 0.05;
  params.reorder = 0.05;
  params.reorder_by = milliseconds(40);
  params.blackouts = {{Instant{} + seconds(5), seconds(2), seconds(30)}};
  LinkEmulator link(params, 9);
  const auto sent = send_evenly(link, milliseconds(7), seconds(300), 400);
  const LinkCounters& c = link.counters();
  EXPECT_EQ(c.offered, sent.size());
  EXPECT_EQ(c.offered + c.duplicated,
            c.delivered + c.queue_full + c.faded + c.lost + c.blacked_out);
  EXPECT_EQ(c.bytes, (c.offered - c.queue_full) * (400 + kOverhead));
  for (const std::uint64_t count :
       {c.queue_full, c.faded, c.lost, c.blacked_out, c.duplicated, c.corrupted, c.reordered})
    EXPECT_GT(count, 0U);
}

TEST(LinkEmulator, SpoilsOneBitOfTheShareThatWasAskedFor) {
  LinkParams params;
  params.corrupt = 0.1;
  LinkEmulator link(params, 13);
  const std::vector<std::uint8_t> bytes(64, 0);
  int spoiled = 0;
  for (int i = 0; i < 10'000; ++i) {
    link.offer(bytes, Instant{i});
    const auto datagram = link.take(Instant{i});
    ASSERT_TRUE(datagram);
    int bits = 0;
    for (const std::uint8_t byte : datagram->bytes) bits += __builtin_popcount(byte);
    ASSERT_LE(bits, 1);
    spoiled += bits;
  }
  EXPECT_NEAR(spoiled, 1'000, 100);
  EXPECT_EQ(link.counters().corrupted, static_cast<std::uint64_t>(spoiled));
}

TEST(LinkEmulator, WhatIsHeldBackComesSoMuchLaterAndTheRestKeepsItsOrder) {
  LinkParams params;
  params.delay = milliseconds(10);
  params.jitter = milliseconds(30);
  params.reorder = 0.1;
  params.reorder_by = milliseconds(200);
  LinkEmulator link(params, 17);
  const auto sent = send_evenly(link, milliseconds(5), seconds(60), 64);
  Instant last{};
  std::size_t held = 0;
  for (const Sent& s : sent) {
    ASSERT_TRUE(s.arrived);
    if (s.arrives - s.at > milliseconds(10 + 30)) {
      ++held;
      continue;
    }
    ASSERT_GE(s.arrives, last);
    last = s.arrives;
  }
  EXPECT_NEAR(static_cast<double>(held) / static_cast<double>(sent.size()), 0.1, 0.01);
  EXPECT_GT(link.counters().reordered, 0U);
}

TEST(LinkEmulator, NothingPassesABlackoutAndItComesAgainEachLap) {
  LinkParams params;
  params.blackouts = {{Instant{} + seconds(10), seconds(2), seconds(60)},
                      {Instant{} + seconds(30), seconds(1), {}}};
  LinkEmulator link(params, 1);
  for (const Sent& s : send_evenly(link, milliseconds(20), seconds(180), 64)) {
    const double at = Duration{s.at.ns}.seconds(), in_lap = std::fmod(at, 60.0);
    const bool dark = (in_lap >= 10.0 && in_lap < 12.0) || (at >= 30.0 && at < 31.0);
    ASSERT_EQ(s.arrived, !dark) << at;
    ASSERT_EQ(link.faded(s.at), dark) << at;
  }
}

TEST(LinkEmulator, FadedTellsTheAirOfNowWhileDatagramsRunAhead) {
  LinkParams params = bursty(0.5, milliseconds(120), 8'000.0, {});
  LinkEmulator link(params, 21);
  const LinkTrace trace = trace_of(params.fades, 21, seconds(60));
  const std::vector<std::uint8_t> bytes(1'000);
  for (Instant at{}; at < Instant{} + seconds(60); at += milliseconds(1)) {
    if (at.ns % 50'000'000 == 0) link.offer(bytes, at);  // the queue is up to two seconds long
    ASSERT_EQ(link.faded(at), loss_over_time(trace, at) > 0.0);
  }
}

TEST(LinkEmulator, LosesByPlaceWhereTheRecordingDoes) {
  LinkParams params;
  params.trace.by_station = {{0.0, 0.0}, {1'000.0, 1.0}, {2'000.0, 0.0}};
  params.trace.lap_length_m = 3'000.0;
  LinkEmulator link(params, 1);
  const std::vector<std::uint8_t> bytes(10);
  for (int metre = 0; metre < 6'000; metre += 10) {
    link.place(metre);
    link.offer(bytes, Instant{metre});
    const int in_lap = metre % 3'000;
    EXPECT_EQ(link.take(Instant{metre}).has_value(), in_lap <= 500 || in_lap > 1'500) << metre;
  }
}

// An hour is cheap because nothing is done for time, only for datagrams and changes of state.
TEST(LinkEmulator, WorkIsForDatagramsNotForTime) {
  LinkEmulator link(bursty(0.3, milliseconds(120), 32'000.0, milliseconds(15)), 1);
  const std::vector<std::uint8_t> bytes(148);
  std::size_t most_under_way = 0, taken = 0, under_way = 0, offered = 0;
  for (Instant at{}; at < Instant{} + seconds(3'600); at += milliseconds(10)) {
    const std::uint64_t dropped_before = link.counters().faded;
    link.offer(bytes, at);
    ++offered;
    under_way += link.counters().faded == dropped_before ? 1U : 0U;
    most_under_way = std::max(most_under_way, under_way);
    while (link.take(at)) ++taken, --under_way;
  }
  EXPECT_EQ(offered, 360'000U);
  EXPECT_GT(taken, offered / 2);
  EXPECT_LE(most_under_way, 4U);  // so that an insertion in order is at the end
}

}  // namespace
}  // namespace pitwall::link
