// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/messages/message_log.hpp"

#include <gtest/gtest.h>

namespace pitwall::service {
namespace {

constexpr Instant kAt{seconds(500).ns};

TEST(MessageLog, EverySubscriberGetsTheVeryTexts) {
  MessageLog log;
  std::vector<std::string> first, second;
  for (auto* const kept : {&first, &second}) {
    log.subscribe([kept](std::string_view type, std::string_view text, Instant at) {
      EXPECT_EQ(at, kAt);
      kept->push_back(std::string{type} + std::string{text});
    });
  }
  log.add_line("audit", "{1}", kAt);
  log.set_state("fuel", "{2}", kAt);
  log.pass("hello", "{3}", kAt);
  EXPECT_EQ(first, (std::vector<std::string>{"audit{1}", "fuel{2}", "hello{3}"}));
  EXPECT_EQ(second, first);
}

TEST(MessageLog, KeepsTheNewestStateAndTheLastLines) {
  MessageLog log;
  log.set_state("link", "{1}", kAt);
  log.set_state("link", "{2}", kAt);
  log.pass("hello", "{}", kAt);
  for (std::size_t i = 0; i < MessageLog::kLines + 5; ++i)
    log.add_line("audit", std::to_string(i), kAt);
  ASSERT_EQ(log.states().size(), 1u);
  EXPECT_EQ(log.states().at("link"), "{2}");
  ASSERT_EQ(log.lines().at("audit").size(), MessageLog::kLines);
  EXPECT_EQ(log.lines().at("audit").front(), "5");
  log.set_state("laps", "{3}", kAt);
  log.clear("laps");
  ASSERT_EQ(log.states().size(), 1U);
  EXPECT_EQ(log.states().at("laps"), "{3}");
  EXPECT_TRUE(log.lines().empty());
  log.clear();
  EXPECT_TRUE(log.states().empty());
  EXPECT_TRUE(log.lines().empty());
}

}  // namespace
}  // namespace pitwall::service
