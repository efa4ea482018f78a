// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/web/client_queue.hpp"

#include <gtest/gtest.h>

namespace pitwall::outlets::web {
namespace {

SharedMessage picture(std::uint32_t number) {
  return std::make_shared<const Message>(Message{.frame = Frame{.sequence = number}});
}
SharedMessage text(const std::string& text) {
  return std::make_shared<const Message>(Message{.text = text});
}

TEST(ClientQueue, KeepsTheOrder) {
  ClientQueue queue;
  EXPECT_TRUE(queue.push(text("a")));
  EXPECT_TRUE(queue.push(picture(1)));
  EXPECT_TRUE(queue.push(text("b")));
  EXPECT_EQ(queue.pop()->text, "a");
  EXPECT_EQ(queue.pop()->frame->sequence, 1u);
  EXPECT_EQ(queue.pop()->text, "b");
  EXPECT_EQ(queue.pop(), nullptr);
}

TEST(ClientQueue, OneThatDoesNotReadLosesItsOldestPicturesAndNoText) {
  ClientQueue queue;
  EXPECT_TRUE(queue.push(text("first")));
  for (std::uint32_t i = 0; i < 1'000; ++i) EXPECT_TRUE(queue.push(picture(i)));
  EXPECT_TRUE(queue.push(text("last")));
  EXPECT_EQ(queue.dropped(), 1'000 - ClientQueue::kPictures);
  EXPECT_EQ(queue.pop()->text, "first");
  for (std::uint32_t i = 0; i < ClientQueue::kPictures; ++i) {
    EXPECT_EQ(queue.pop()->frame->sequence, 1'000 - ClientQueue::kPictures + i);
  }
  EXPECT_EQ(queue.pop()->text, "last");
  EXPECT_TRUE(queue.empty());
}

TEST(ClientQueue, TooMuchUnreadTextEndsIt) {
  ClientQueue queue;
  const std::string long_text(64 * 1'024, 'x');
  std::size_t pushed = 0;
  while (queue.push(text(long_text))) ++pushed;
  EXPECT_EQ(pushed, ClientQueue::kUnreadMax / long_text.size());
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
}  // namespace pitwall::outlets::web
