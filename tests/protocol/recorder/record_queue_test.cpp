// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/record_queue.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace pitwall::recorder {
namespace {

TEST(RecordQueue, GivesBackWhatWasPushedInOrder) {
  RecordQueue queue{1 << 16};
  for (std::uint8_t i = 0; i < 100; ++i) {
    const std::vector<std::uint8_t> data(i, i);
    EXPECT_TRUE(queue.push({.channel = i, .logged = {i}, .published = {-i}, .data = data}));
  }
  Batch batch;
  EXPECT_TRUE(queue.take_all(batch, Duration{}));
  for (std::uint8_t i = 0; i < 100; ++i) {
    const auto record = batch.next();
    ASSERT_TRUE(record);
    EXPECT_EQ(record->channel, i);
    EXPECT_EQ(record->logged, Instant{i});
    EXPECT_EQ(record->published, Instant{-i});
    EXPECT_EQ(std::vector<std::uint8_t>(record->data.begin(), record->data.end()),
              std::vector<std::uint8_t>(i, i));
  }
  EXPECT_FALSE(batch.next());
}

TEST(RecordQueue, WhatDoesNotFitIsDroppedAndCounted) {
  RecordQueue queue{1'000};
  const std::vector<std::uint8_t> data(100);
  int kept = 0;
  for (int i = 0; i < 50; ++i) kept += queue.push({.data = data}) ? 1 : 0;
  EXPECT_GT(kept, 3);
  EXPECT_EQ(queue.dropped(), 50U - static_cast<unsigned>(kept));
  Batch batch;
  queue.take_all(batch, Duration{});
  int there = 0;
  while (batch.next()) ++there;
  EXPECT_EQ(there, kept);
  EXPECT_TRUE(queue.push({.data = data}));  // there is room again
}

TEST(RecordQueue, AfterItsEndOneLastBatchComes) {
  RecordQueue queue{1 << 16};
  std::uint64_t taken = 0;
  std::thread writer{[&] {
    Batch batch;
    for (bool more = true; more;) {
      more = queue.take_all(batch, seconds(60));
      while (batch.next()) ++taken;
    }
  }};
  std::uint64_t pushed = 0;
  for (int i = 0; i < 20'000; ++i) pushed += queue.push({.channel = 1, .data = {}}) ? 1U : 0U;
  queue.close();
  writer.join();
  EXPECT_EQ(taken, pushed);
  EXPECT_EQ(pushed + queue.dropped(), 20'000U);
  EXPECT_FALSE(queue.push({.data = {}}));
}

}  // namespace
}  // namespace pitwall::recorder
