// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/netlink_message.hpp"

#include <gtest/gtest.h>
#include <linux/rtnetlink.h>

#include <string>
#include <vector>

namespace pitwall::transport {
namespace {

TEST(NetlinkMessage, WhatIsPutIsReadBackByTheKernelsOwnMacros) {
  ifinfomsg link{};
  link.ifi_index = 7;
  NetlinkRequest request(RTM_NEWLINK, NLM_F_ACK, link);
  request.put(1, std::uint32_t{0x01020304});
  request.put_text(2, "can");
  const std::size_t outer = request.open_nest(3);
  request.put(4, std::uint8_t{9});
  request.put(5, std::uint16_t{10});
  request.close_nest(outer);
  const NetlinkBytes bytes = request.bytes(42);

  alignas(nlmsghdr) std::array<std::uint8_t, 512> copy{};
  std::copy(bytes.begin(), bytes.end(), copy.begin());
  const auto* head = reinterpret_cast<const nlmsghdr*>(copy.data());
  EXPECT_EQ(head->nlmsg_len, bytes.size());
  EXPECT_EQ(head->nlmsg_seq, 42u);
  EXPECT_EQ(head->nlmsg_type, RTM_NEWLINK);
  EXPECT_EQ(head->nlmsg_flags, NLM_F_REQUEST | NLM_F_ACK);
  const auto* body = reinterpret_cast<const ifinfomsg*>(copy.data() + 16);
  EXPECT_EQ(body->ifi_index, 7);
  std::vector<int> seen;
  auto left = static_cast<int>(bytes.size()) - 16 - 16;
  for (const auto* a = reinterpret_cast<const rtattr*>(copy.data() + 32);
       left >= 4 && a->rta_len >= 4 && a->rta_len <= left;) {
    seen.push_back(a->rta_type);
    if (a->rta_type == 1) {
      EXPECT_EQ(a->rta_len, 8);
    }
    if (a->rta_type == 2) {
      EXPECT_EQ(a->rta_len, 8);
    }  // "can" and its zero
    if (a->rta_type == 3) {
      EXPECT_EQ(a->rta_len, 4 + 8 + 8);
    }
    const int step = (a->rta_len + 3) / 4 * 4;
    left -= step;
    a = reinterpret_cast<const rtattr*>(reinterpret_cast<const std::uint8_t*>(a) + step);
  }
  EXPECT_EQ(seen, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(left, 0);

  for_each_attribute(attributes_after<ifinfomsg>(bytes.subspan(16)),
                     [&](unsigned attribute, NetlinkBytes value) {
                       if (attribute == 1) {
                         EXPECT_EQ(read_as<std::uint32_t>(value), 0x01020304u);
                       }
                       if (attribute == 2) {
                         EXPECT_EQ(read_text(value), "can");
                       }
                     });
}

TEST(NetlinkMessage, ShortValuesAreZeroExtendedAndTextNeedsNoEnd) {
  const std::vector<std::uint8_t> bytes{1, 2};
  EXPECT_EQ(read_as<std::uint32_t>(bytes), 0x0201u);
  EXPECT_EQ(read_as<std::uint64_t>({}), 0u);
  const std::string text = "abc";
  EXPECT_EQ(read_text({reinterpret_cast<const std::uint8_t*>(text.data()), 2}), "ab");
}

// Whatever the bytes: attributes lie within them, and the walk ends.
TEST(NetlinkMessage, NoLengthLeadsOutsideTheMessage) {
  std::uint64_t state = 1;
  for (int round = 0; round < 2'000; ++round) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(round % 67));
    for (std::uint8_t& b : bytes) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      b = static_cast<std::uint8_t>((state >> 59) & 0x0F);
    }
    for_each_attribute(bytes, [&](unsigned, NetlinkBytes value) {
      ASSERT_GE(value.data(), bytes.data());
      ASSERT_LE(value.data() + value.size(), bytes.data() + bytes.size());
    });
  }
}

}  // namespace
}  // namespace pitwall::transport
