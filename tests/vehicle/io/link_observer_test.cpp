// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/link_observer.hpp"

#include <gtest/gtest.h>

namespace pitwall::io {
namespace {

using transport::BusState;
using transport::CanInterfaceStatus;
using world::ControllerState;

constexpr Instant kAsked{seconds(5).ns};
constexpr BusState kStates[] = {BusState::kActive, BusState::kWarning, BusState::kPassive,
                                BusState::kBusOff};

CanInterfaceStatus report(BusState state) {
  CanInterfaceStatus out;
  out.at = kAsked;
  out.exists = out.up = out.running = out.has_controller = true;
  out.state = state;
  return out;
}

ControllerState seen(const CanInterfaceStatus& interface, BusState frames, Instant at) {
  return LinkObserver{}
      .observe({.interface = interface, .reported_by_frames = frames, .reported_at = at})
      .controller;
}

ControllerState named(BusState state) {
  return static_cast<ControllerState>(state);  // the same names in the same order, up to bus-off
}
static_assert(static_cast<int>(ControllerState::kBusOff) == static_cast<int>(BusState::kBusOff));

TEST(LinkObserver, TheNewestNewsWinsAndOfEquallyOldTheWorse) {
  for (const BusState by_report : kStates)
    for (const BusState by_frames : kStates) {
      const auto interface = report(by_report);
      EXPECT_EQ(seen(interface, by_frames, kAsked + nanoseconds(1)), named(by_frames));
      EXPECT_EQ(seen(interface, by_frames, kAsked - nanoseconds(1)), named(by_report));
      EXPECT_EQ(seen(interface, by_frames, kAsked), named(std::max(by_report, by_frames)));
    }
}

TEST(LinkObserver, AnInterfaceThatIsNotUpIsDownWhateverWasSaid) {
  for (const BusState state : kStates) {
    auto down = report(state);
    down.up = false;
    EXPECT_EQ(seen(down, BusState::kActive, kAsked + seconds(1)), ControllerState::kDown);
    EXPECT_EQ(seen({}, state, kAsked), ControllerState::kDown);
  }
}

TEST(LinkObserver, ABusWhoseHubHasHungUpIsDownBeforeAnyReportSaysSo) {
  for (const BusState state : kStates) {
    const auto interface = report(state);
    const auto link = LinkObserver{}.observe({.interface = interface,
                                              .reported_by_frames = BusState::kActive,
                                              .reported_at = kAsked + seconds(1),
                                              .hung_up = true});
    EXPECT_EQ(link.controller, ControllerState::kDown);
  }
}

TEST(LinkObserver, WithoutAControllerOnlyErrorFramesTellAndElseNothingIsKnown) {
  auto vcan = report(BusState::kUnknown);
  vcan.has_controller = false;
  EXPECT_EQ(seen(vcan, BusState::kUnknown, {}), ControllerState::kUnknown);
  for (const BusState state : kStates)
    EXPECT_EQ(seen(vcan, state, kAsked - seconds(1)), named(state));
}

TEST(LinkObserver, LossesAndRestartsCountFromTheStartAndSurviveANewDriver) {
  LinkObserver observer;
  auto interface = report(BusState::kActive);
  const auto observe = [&] { return observer.observe({.interface = interface, .down_and_up = 2}); };
  interface.rx_dropped = 100;
  interface.rx_over_errors = 20;
  interface.restarts = 5;
  EXPECT_EQ(observe().lost_in_interface, 0u);
  EXPECT_EQ(observe().restarts, 2u);
  interface.rx_over_errors = 23;
  interface.rx_dropped = 101;
  interface.restarts = 6;
  EXPECT_EQ(observe().lost_in_interface, 4u);
  EXPECT_EQ(observe().restarts, 3u);
  interface.rx_dropped = 0;
  interface.rx_over_errors = 2;  // loaded anew
  EXPECT_EQ(observe().lost_in_interface, 6u);
}

TEST(LinkObserver, WhatTheSocketAndTheWayOutSayIsPassedOn) {
  const auto interface = report(BusState::kActive);
  const auto link = LinkObserver{}.observe({.interface = interface,
                                            .lost_in_socket = 7,
                                            .error_frames = 8,
                                            .tx_drops = 9,
                                            .tx_stalled = milliseconds(30)});
  EXPECT_EQ(link.lost_in_socket, 7u);
  EXPECT_EQ(link.error_frames, 8u);
  EXPECT_EQ(link.tx_drops, 9u);
  EXPECT_EQ(link.tx_stalled, milliseconds(30));
}

}  // namespace
}  // namespace pitwall::io
