// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/can_wire.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/protocol/transport/any_frame.hpp"

namespace pitwall::transport {
namespace {

TEST(CanWire, ThereAndBackIsIdentity) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 50'000; ++i) {
    const can::Frame f = any_frame(random);
    CanWire wire{};
    const std::size_t bytes = to_wire(f, wire);
    ASSERT_EQ(bytes, f.fd ? 72U : 16U);
    can::Frame back;
    ASSERT_TRUE(from_wire(wire, bytes, back));
    ASSERT_EQ(back, f);
  }
}

TEST(CanWire, WhatIsCarriedIsWhatBecomesASendableFrameUnchangedOrAnErrorFrame) {
  std::mt19937_64 random(19);
  std::size_t carried = 0, refused = 0;
  for (int i = 0; i < 200'000; ++i) {
    CanWire wire{};
    wire.can_id = static_cast<std::uint32_t>(random()) >> (random() % 2 == 0 ? 21 : 0);
    wire.len = static_cast<std::uint8_t>(random() % 70);
    const std::size_t bytes = random() % 2 == 0 ? kCanWireBytes : kCanFdWireBytes;
    can::Frame frame;
    CanWire back{};
    const bool same = from_wire(wire, bytes, frame) && to_wire(frame, back) == bytes &&
                      back.can_id == wire.can_id && back.len == wire.len;
    const bool error = bytes == kCanWireBytes && wire.len <= 8 && wire.can_id >> 29U == 1;
    ASSERT_EQ(is_carried(wire, bytes), same || error) << std::hex << wire.can_id;
    ++(same || error ? carried : refused);
  }
  EXPECT_GT(std::min(carried, refused), 10'000u);
  for (std::size_t bytes = 0; bytes <= 100; ++bytes)
    EXPECT_EQ(is_carried(CanWire{}, bytes), bytes == kCanWireBytes || bytes == kCanFdWireBytes);
}

TEST(CanWire, WhatNoBusCanCarryIsRefused) {
  CanWire wire{};
  can::Frame f;
  f.id = 0x800;
  EXPECT_EQ(to_wire(f, wire), 0U);
  f.extended = true;
  EXPECT_EQ(to_wire(f, wire), 16U);
  f.id = 0x20000000;
  EXPECT_EQ(to_wire(f, wire), 0U);
  f.id = 1;
  f.length = 9;
  EXPECT_EQ(to_wire(f, wire), 0U);
  f.fd = true;
  EXPECT_EQ(to_wire(f, wire), 0U);  // CAN FD jumps from 8 to 12
  f.length = 12;
  EXPECT_EQ(to_wire(f, wire), 72U);
  f.remote = true;
  EXPECT_EQ(to_wire(f, wire), 0U);
}

TEST(CanWire, AnyBytesAreAFrameOrRefusedNeverMore) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 50'000; ++i) {
    CanWire wire{};
    auto* bytes = reinterpret_cast<std::uint8_t*>(&wire);
    for (std::size_t k = 0; k < sizeof wire; ++k) bytes[k] = static_cast<std::uint8_t>(random());
    for (const std::size_t size : {0U, 15U, 16U, 17U, 71U, 72U}) {
      can::Frame f;
      if (!from_wire(wire, size, f)) continue;
      ASSERT_TRUE(size == 16 || size == 72);
      ASSERT_LE(f.length, size == 72 ? 64 : 8);
      ASSERT_LE(f.id, f.extended ? can::kMaxExtendedId : can::kMaxStandardId);
      ASSERT_FALSE(is_error_frame(wire));
    }
  }
}

TEST(CanWire, ErrorFramesChangeTheStateAsTheKernelMeansIt) {
  const auto state_after = [](std::uint32_t classes, std::uint8_t detail, BusState before) {
    CanWire wire{};
    wire.can_id = CAN_ERR_FLAG | classes;
    wire.data[1] = detail;
    CanErrorCounters counters;
    return decode_error(wire, before, counters);
  };
  EXPECT_EQ(state_after(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_WARNING, BusState::kActive),
            BusState::kWarning);
  EXPECT_EQ(state_after(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE, BusState::kWarning),
            BusState::kPassive);
  EXPECT_EQ(state_after(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE, BusState::kPassive), BusState::kActive);
  EXPECT_EQ(state_after(CAN_ERR_BUSOFF, 0, BusState::kPassive), BusState::kBusOff);
  EXPECT_EQ(state_after(CAN_ERR_RESTARTED, 0, BusState::kBusOff), BusState::kActive);
  EXPECT_EQ(state_after(CAN_ERR_ACK, 0, BusState::kWarning), BusState::kWarning);
  EXPECT_EQ(state_after(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW, BusState::kUnknown),
            BusState::kUnknown);
}

TEST(CanWire, EveryClassOfOneErrorFrameIsCounted) {
  CanWire wire{};
  wire.can_id = CAN_ERR_FLAG | CAN_ERR_TX_TIMEOUT | CAN_ERR_LOSTARB | CAN_ERR_CRTL | CAN_ERR_PROT |
                CAN_ERR_TRX | CAN_ERR_ACK | CAN_ERR_BUSOFF | CAN_ERR_BUSERROR | CAN_ERR_RESTARTED;
  CanErrorCounters counters;
  static_cast<void>(decode_error(wire, BusState::kActive, counters));
  EXPECT_EQ(counters, (CanErrorCounters{1, 1, 1, 1, 1, 1, 1, 1, 1}));
}

}  // namespace
}  // namespace pitwall::transport
