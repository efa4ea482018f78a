// SPDX-License-Identifier: Apache-2.0
#include "protocol/vocabulary/udp_address.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>

#include <array>

namespace pitwall {
namespace {

// The C library's text of the same address.
std::string libc_text(const UdpAddress& a) {
  const in_addr address{.s_addr = htonl(a.ip)};
  std::array<char, INET_ADDRSTRLEN> text{};
  EXPECT_NE(inet_ntop(AF_INET, &address, text.data(), text.size()), nullptr);
  return std::string{text.data()} + ":" + std::to_string(a.port);
}

TEST(UdpAddress, HasTheTextThatTheCLibraryGivesIt) {
  for (const std::uint32_t ip : {kLoopbackIp, 0U, 0xFFFF'FFFFU, 0x0A2A'0007U, 0x0102'0304U})
    for (const std::uint16_t port : {std::uint16_t{0}, std::uint16_t{7'300}, std::uint16_t{65'535}})
      EXPECT_EQ(to_string({.ip = ip, .port = port}), libc_text({.ip = ip, .port = port}));
}

TEST(UdpAddress, IsTheLoopbackAndNotKnownUntilSet) {
  EXPECT_EQ(UdpAddress{}.ip, kLoopbackIp);
  EXPECT_FALSE(UdpAddress{}.known());
  EXPECT_TRUE((UdpAddress{.port = 1}).known());
}

}  // namespace
}  // namespace pitwall
