// Control data of a received message: time of arrival and number of messages lost before.
//   in     the msghdr of a socket with SO_TIMESTAMPNS and SO_RXQ_OVFL
//   out    stamp on the calendar clock (0: no stamp); drop count of the socket's queue so far
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>

#include <cstdint>
#include <cstring>
#include <ctime>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

inline constexpr std::size_t kControlBytes =
    CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t));
static_assert(kControlBytes % alignof(cmsghdr) == 0);

struct ControlData {
  UtcTime stamp{};
  std::uint32_t dropped = 0;
};

inline ControlData read_control(msghdr& header) {
  ControlData out;
  for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
    if (c->cmsg_level != SOL_SOCKET) continue;
    if (c->cmsg_type == SCM_TIMESTAMPNS) {
      timespec t{};
      std::memcpy(&t, CMSG_DATA(c), sizeof t);
      out.stamp = {t.tv_sec * kNanosecondsPerSecond + t.tv_nsec};
    } else if (c->cmsg_type == SO_RXQ_OVFL) {
      std::memcpy(&out.dropped, CMSG_DATA(c), sizeof out.dropped);
    }
  }
  return out;
}

}  // namespace pitwall::transport
