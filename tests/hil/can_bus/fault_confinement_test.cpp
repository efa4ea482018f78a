// The numbers of the standard, one by one.
// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/fault_confinement.hpp"

#include <gtest/gtest.h>

namespace pitwall::can_bus {
namespace {

TEST(FaultConfinement, ThirtyTwoErrorsWhileSendingAreBusOff) {
  FaultConfinement node;
  for (int i = 1; i <= 32; ++i) {
    EXPECT_EQ(failed_to_send(node), i == 32) << i;
    EXPECT_EQ(node.send_errors, 8 * i);
    const ErrorState expected = i < 12   ? ErrorState::kActive
                                : i < 16 ? ErrorState::kWarning
                                : i < 32 ? ErrorState::kPassive
                                         : ErrorState::kBusOff;
    EXPECT_EQ(state_of(node), expected) << i;
  }
}

TEST(FaultConfinement, HearingErrorsNeverMakesBusOff) {
  FaultConfinement node;
  for (int i = 1; i <= 1000; ++i) {
    note_receive_error(node);
    const ErrorState expected = i < 96    ? ErrorState::kActive
                                : i < 128 ? ErrorState::kWarning
                                          : ErrorState::kPassive;
    ASSERT_EQ(state_of(node), expected) << i;
  }
  receive(node);
  EXPECT_EQ(node.receive_errors, 127) << "one good frame ends being passive";
  EXPECT_EQ(state_of(node), ErrorState::kWarning);
  for (int i = 0; i < 200; ++i) receive(node);
  EXPECT_EQ(node.receive_errors, 0);
}

TEST(FaultConfinement, EightGoodFramesPayForOneError) {
  FaultConfinement node;
  for (int round = 0; round < 100; ++round) {
    failed_to_send(node);
    EXPECT_EQ(node.send_errors, 8);
    for (int i = 0; i < 8; ++i) sent(node);
    EXPECT_EQ(node.send_errors, 0);
  }
  sent(node);
  EXPECT_EQ(node.send_errors, 0) << "not below";
}

FaultConfinement bus_off() {
  FaultConfinement node;
  while (!failed_to_send(node)) {
  }
  return node;
}

TEST(FaultConfinement, NothingEndsBusOffButARestartAnd128Times11Bits) {
  FaultConfinement node = bus_off();
  sent(node);
  receive(node);
  EXPECT_FALSE(see_idle_bits(node, 1'000'000));
  EXPECT_EQ(state_of(node), ErrorState::kBusOff);
  ASSERT_TRUE(restart(node));
  EXPECT_FALSE(restart(node)) << "one is under way";
  EXPECT_FALSE(see_idle_bits(node, 128 * 11 - 1));
  EXPECT_EQ(state_of(node), ErrorState::kBusOff);
  EXPECT_TRUE(see_idle_bits(node, 1));
  EXPECT_EQ(state_of(node), ErrorState::kActive);
  EXPECT_EQ(node.send_errors, 0);
  EXPECT_EQ(node.receive_errors, 0);
}

TEST(FaultConfinement, EveryFrameIsOneRunAndBreaksTheOneUnderWay) {
  FaultConfinement node = bus_off();
  ASSERT_TRUE(restart(node));
  for (int i = 0; i < 127; ++i) {
    EXPECT_FALSE(see_idle_bits(node, 10)) << "ten recessive bits are no run";
    EXPECT_FALSE(see_frame(node));
  }
  EXPECT_FALSE(see_idle_bits(node, 10));
  EXPECT_TRUE(see_frame(node));
  EXPECT_EQ(state_of(node), ErrorState::kActive);
}

}  // namespace
}  // namespace pitwall::can_bus
