// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/refusal.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace pitwall::telemetry {
namespace {

TEST(Refusal, EachHasWordsOfItsOwn) {
  std::set<std::string> words;
  for (std::size_t i = 0; i < kRefusals; ++i) words.insert(text_of(static_cast<Refusal>(i)));
  EXPECT_EQ(words.size(), kRefusals);
  EXPECT_FALSE(words.contains(""));
}

}  // namespace
}  // namespace pitwall::telemetry
