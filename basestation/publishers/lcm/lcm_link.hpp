// Sender of LCM messages through LCM's own library. It subscribes to nothing, so that no message of
// another program is read here.
//   in     the destination udpm://ADDRESS:PORT?ttl=N; channel and message
//   invariants
//          with a ttl of 0, the default of a URL without one, messages stay on this machine
//   errors parse(): Problem for another provider, an address that is not multicast, no port, a ttl
//          beyond 255. open(): Problem if the library finds no route. publish(): false if the
//          network did not accept the message
//   source LCM 1.3.1: lcm.h, lcm_udpm.c
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::publishers::lcm {

inline constexpr std::string_view kDefaultUrl = "udpm://239.255.76.67:7667?ttl=0";

struct LcmUrl {
  std::string address;
  std::uint16_t port = 0;
  int ttl = 0;

  static Result<LcmUrl, Problem> parse(std::string_view text);
  std::string text() const;
  bool leaves_the_machine() const { return ttl > 0; }
};

class LcmLink {
 public:
  static Result<LcmLink, Problem> open(const LcmUrl& url);

  bool publish(const std::string& channel, std::span<const std::uint8_t> message);

 private:
  struct Close {
    void operator()(void* lcm) const;
  };
  explicit LcmLink(void* lcm) : lcm_(lcm) {}

  std::unique_ptr<void, Close> lcm_;
};

}  // namespace pitwall::publishers::lcm
