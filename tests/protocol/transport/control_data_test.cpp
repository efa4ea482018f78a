// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/control_data.hpp"

#include <gtest/gtest.h>

#include <array>

namespace pitwall::transport {
namespace {

struct Message {
  alignas(cmsghdr) std::array<std::uint8_t, 2 * kControlBytes> control{};
  msghdr header{};
  std::size_t used = 0;

  template <class T>
  void add(int level, int type, const T& value) {
    auto* c = reinterpret_cast<cmsghdr*>(control.data() + used);
    c->cmsg_level = level;
    c->cmsg_type = type;
    c->cmsg_len = CMSG_LEN(sizeof value);
    std::memcpy(CMSG_DATA(c), &value, sizeof value);
    used += CMSG_SPACE(sizeof value);
    header.msg_control = control.data();
    header.msg_controllen = used;
  }
};

TEST(ControlData, StampAndDropsAreFoundInAnyOrder) {
  const timespec stamp{.tv_sec = 1'700'000'000, .tv_nsec = 123'456'789};
  const std::uint32_t drops = 59'722;
  Message stamp_first, drops_first;
  stamp_first.add(SOL_SOCKET, SCM_TIMESTAMPNS, stamp);
  stamp_first.add(SOL_SOCKET, SO_RXQ_OVFL, drops);
  drops_first.add(SOL_SOCKET, SO_RXQ_OVFL, drops);
  drops_first.add(SOL_SOCKET, SCM_TIMESTAMPNS, stamp);
  for (Message* m : {&stamp_first, &drops_first}) {
    const ControlData data = read_control(m->header);
    EXPECT_EQ(data.stamp.ns, 1'700'000'000'123'456'789);
    EXPECT_EQ(data.dropped, drops);
  }
}

TEST(ControlData, NothingThereIsNothingAndForeignDataIsPassedOver) {
  msghdr empty{};
  EXPECT_EQ(read_control(empty).stamp.ns, 0);
  Message foreign;
  foreign.add(SOL_SOCKET + 1, SCM_TIMESTAMPNS, timespec{.tv_sec = 5, .tv_nsec = 5});
  EXPECT_EQ(read_control(foreign.header).stamp.ns, 0);
  EXPECT_EQ(read_control(foreign.header).dropped, 0U);
}

}  // namespace
}  // namespace pitwall::transport
