// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/client_queue.hpp"

#include <gtest/gtest.h>

#include "tests/basestation/publishers/web/server_fixture.hpp"

namespace pitwall::publishers::web {
namespace {

TEST(ClientQueue, KeepsTheOrder) {
  ClientQueue queue;
  EXPECT_TRUE(queue.push(text("a")));
  EXPECT_TRUE(queue.push(vehicle(1, 0)));
  EXPECT_TRUE(queue.push(text("b")));
  EXPECT_EQ(queue.pop()->text, "a");
  EXPECT_EQ(queue.pop()->frame->sequence, 1u);
  EXPECT_EQ(queue.pop()->text, "b");
  EXPECT_EQ(queue.pop(), nullptr);
}

TEST(ClientQueue, OneThatDoesNotReadLosesItsOldestPicturesAndNoText) {
  ClientQueue queue;
  EXPECT_TRUE(queue.push(text("first")));
  for (std::uint32_t i = 0; i < 1'000; ++i) EXPECT_TRUE(queue.push(vehicle(i, 0)));
  EXPECT_TRUE(queue.push(text("last")));
  EXPECT_EQ(queue.dropped(), 1'000 - QueueLimits{}.snapshots);
  EXPECT_EQ(queue.pop()->text, "first");
  for (std::uint32_t i = 0; i < QueueLimits{}.snapshots; ++i) {
    EXPECT_EQ(queue.pop()->frame->sequence, 1'000 - QueueLimits{}.snapshots + i);
  }
  EXPECT_EQ(queue.pop()->text, "last");
  EXPECT_TRUE(queue.empty());
}

Message tagged_bytes(std::uint32_t tag, std::size_t size) {
  Bytes bytes{.tag = tag};
  bytes.body = std::make_shared<const std::vector<std::uint8_t>>(size);
  return Message{.binary = std::move(bytes)};
}
SharedMessage shared(Message message) {
  return std::make_shared<const Message>(std::move(message));
}

TEST(ClientQueue, TaggedBytesAreLostOldestFirstAndByTheirTag) {
  ClientQueue queue{{.snapshots = 3}};
  for (std::uint32_t tag = 1; tag <= 5; ++tag) queue.push(shared(tagged_bytes(tag, 10)));
  EXPECT_EQ(queue.take_lost_tags(), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_TRUE(queue.take_lost_tags().empty());
  EXPECT_EQ(queue.pop()->binary->tag, 3u);
  EXPECT_EQ(queue.dropped(), 2u);
}

TEST(ClientQueue, TheyAreBoundedByTheirBytesTooButOneAloneIsKept) {
  ClientQueue queue{{.snapshots = 100, .snapshot_bytes = 1'000}};
  for (std::uint32_t tag = 1; tag <= 5; ++tag) queue.push(shared(tagged_bytes(tag, 400)));
  EXPECT_EQ(queue.take_lost_tags(), (std::vector<std::uint32_t>{1, 2, 3}));
  queue.push(shared(tagged_bytes(9, 5'000)));
  EXPECT_EQ(queue.pop()->binary->tag, 9u);
  EXPECT_TRUE(queue.empty());
}

TEST(ClientQueue, BytesWithoutATagAreNeverLost) {
  ClientQueue queue{{.snapshots = 1, .unread_bytes = 1'000}};
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(queue.push(shared(tagged_bytes(0, 100))));
  EXPECT_FALSE(queue.push(shared(tagged_bytes(0, 100))))
      << "but end the client that leaves them unread";
  EXPECT_EQ(queue.dropped(), 0u);
}

TEST(ClientQueue, TooMuchUnreadTextEndsIt) {
  ClientQueue queue;
  const std::string long_text(64 * 1'024, 'x');
  std::size_t pushed = 0;
  while (queue.push(text(long_text))) ++pushed;
  EXPECT_EQ(pushed, QueueLimits{}.unread_bytes / long_text.size());
}

TEST(ClientQueue, WhatIsReadMakesRoom) {
  ClientQueue queue;
  const std::string long_text(64 * 1'024, 'x');
  for (int i = 0; i < 1'000; ++i) {
    EXPECT_TRUE(queue.push(text(long_text)));
    queue.pop();
  }
}

}  // namespace
}  // namespace pitwall::publishers::web
