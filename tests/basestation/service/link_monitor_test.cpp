// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/link_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/basestation/radio_rig.hpp"

namespace pitwall::service {
namespace {

// Measures beside the base's own monitor.
struct Measured : RadioRig {
  state::LinkFigures run_and_measure(Duration length) {
    state::LinkFigures figures;
    for (const Instant end = now + length; now < end;) {
      run(milliseconds(100));
      figures = monitor.measure(*station, base->vehicle(), now);
    }
    return figures;
  }
  LinkMonitor monitor;
};

TEST(LinkMonitor, OfAHealthyLinkTheFiguresAreThoseOfTheRig) {
  Measured rig;
  rig.set(telemetry::field("ego.x"), 1.0);
  const state::LinkFigures figures = rig.run_and_measure(seconds(10));
  EXPECT_NEAR(figures.packets_hz, 50.0, 2.0);
  EXPECT_EQ(figures.down_loss, 0.0);
  EXPECT_GE(figures.round_trip_ms, (RadioRig::kDelay + RadioRig::kDelay).milliseconds());
  EXPECT_GT(figures.down_kbit_s, 0.0);
  ASSERT_TRUE(figures.received);
  EXPECT_LT(rig.now - *figures.received, milliseconds(100));
}

TEST(LinkMonitor, OfALinkThatLosesEveryFourthTheLossIsAQuarter) {
  Measured rig;
  rig.set(telemetry::field("ego.x"), 1.0);
  rig.run_and_measure(seconds(2));
  int packet = 0;
  rig.loses = [&](bool to_base, telemetry::PathId) { return to_base && ++packet % 4 == 0; };
  const state::LinkFigures figures = rig.run_and_measure(seconds(10));
  EXPECT_NEAR(figures.down_loss, 0.25, 0.02);
  EXPECT_NEAR(figures.loss_30s, 0.25 * 10.0 / 12.0, 0.05);
}

TEST(LinkMonitor, BeforeAnythingWasReceivedNothingIsKnown) {
  Measured rig;
  rig.loses = [](bool, telemetry::PathId) { return true; };
  const state::LinkFigures figures = rig.run_and_measure(seconds(1));
  EXPECT_FALSE(figures.received);
  EXPECT_TRUE(std::isnan(figures.down_loss));
  EXPECT_TRUE(std::isnan(figures.round_trip_ms));
}

}  // namespace
}  // namespace pitwall::service
