// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/mailbox.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace pitwall::io {
namespace {

TEST(Mailbox, TheNewestIsTakenOnceAndTheOthersAreCounted) {
  Mailbox<int> mailbox;
  EXPECT_EQ(mailbox.take(), nullptr);
  for (int i = 1; i <= 3; ++i) mailbox.next() = i, mailbox.put();
  const int* const got = mailbox.take();
  ASSERT_NE(got, nullptr);
  EXPECT_EQ(*got, 3);
  EXPECT_EQ(mailbox.overwritten(), 2U);
  EXPECT_EQ(mailbox.take(), nullptr);
  mailbox.next() = 4, mailbox.put();
  EXPECT_EQ(*got, 3) << "it stays as it is until the next is taken";
  EXPECT_EQ(*mailbox.take(), 4);
}

TEST(Mailbox, WhatIsTakenIsNeverHalfOfOneAndHalfOfAnother) {
  constexpr std::uint64_t kLast = 200'000;
  Mailbox<std::array<std::uint64_t, 16>> mailbox;
  std::thread writer{[&] {
    for (std::uint64_t i = 1; i <= kLast; ++i) mailbox.next().fill(i), mailbox.put();
  }};
  std::uint64_t before = 0, taken = 0;
  while (before < kLast) {
    const auto* const got = mailbox.take();
    if (got == nullptr) continue;
    ++taken;
    for (const std::uint64_t value : *got) ASSERT_EQ(value, got->front());
    ASSERT_GT(got->front(), before);
    before = got->front();
  }
  writer.join();
  EXPECT_EQ(taken + mailbox.overwritten(), kLast);
}

}  // namespace
}  // namespace pitwall::io
