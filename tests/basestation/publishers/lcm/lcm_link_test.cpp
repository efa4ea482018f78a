// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/lcm/lcm_link.hpp"

#include <gtest/gtest.h>

namespace pitwall::publishers::lcm {
namespace {

TEST(LcmUrl, TheDefaultStaysOnThisMachine) {
  const auto url = LcmUrl::parse(kDefaultUrl);
  ASSERT_TRUE(url) << to_string(url.error());
  EXPECT_EQ(url->text(), kDefaultUrl);
  EXPECT_FALSE(url->leaves_the_machine());
  EXPECT_EQ(LcmUrl::parse("udpm://239.255.76.67:7667")->ttl, 0);
  EXPECT_TRUE(LcmUrl::parse("udpm://224.0.0.5:1?ttl=255")->leaves_the_machine());
}

TEST(LcmUrl, AnythingElseIsRefusedWithWhatIsWrong) {
  for (const auto& [text, what] : {std::pair{"", "udpm://"},
                                   {"file:///tmp/log?mode=w", "udpm://"},
                                   {"udpm://", "an address"},
                                   {"udpm://239.255.76.67", "a port"},
                                   {"udpm://239.255.76.67:0", "a port"},
                                   {"udpm://239.255.76.67:99999", "a port"},
                                   {"udpm://127.0.0.1:7667", "multicast"},
                                   {"udpm://239.255.76.67:7667?ttl=", "ttl"},
                                   {"udpm://239.255.76.67:7667?ttl=256", "ttl"},
                                   {"udpm://239.255.76.67:7667?ttl=-1", "ttl"},
                                   {"udpm://239.255.76.67:7667?ttl=1x", "ttl"},
                                   {"udpm://239.255.76.67:7667?recv_buf_size=1", "ttl=N"}}) {
    const auto url = LcmUrl::parse(text);
    ASSERT_FALSE(url) << text;
    EXPECT_NE(to_string(url.error()).find(what), std::string::npos) << to_string(url.error());
  }
}

}  // namespace
}  // namespace pitwall::publishers::lcm
