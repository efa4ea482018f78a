// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/link_state.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pitwall::state {
namespace {

struct Radio {
  LinkStateMonitor evaluator;
  LinkFigures figures;
  Instant now{seconds(10).ns};
  std::vector<LinkState> states{LinkState::kNone};

  void run(Duration length, bool packets, double loss = 0.0, double round_trip_ms = 20.0) {
    figures.down_loss = loss;
    figures.round_trip_ms = round_trip_ms;
    for (const Instant end = now + length; now < end; now += milliseconds(10)) {
      if (packets) figures.received = now;
      evaluator.step(figures, now);
      if (evaluator.state() != states.back()) states.push_back(evaluator.state());
    }
  }
};

using enum LinkState;
using States = std::vector<LinkState>;

TEST(LinkState, SilenceIsLost) {
  Radio radio;
  radio.run(seconds(1), true);
  const Instant last = *radio.figures.received;
  radio.run(seconds(2), false);
  EXPECT_EQ(radio.states, (States{kNone, kGood, kLost}));
  EXPECT_EQ(radio.evaluator.since() - last, LinkStateMonitor::kLostAfter);
}

TEST(LinkState, GoodAgainOnlyAfterTwoSteadySeconds) {
  Radio radio;
  radio.run(seconds(1), true);
  radio.run(seconds(1), false);
  radio.run(milliseconds(1'900), true);
  EXPECT_EQ(radio.evaluator.state(), kDegraded);
  radio.run(seconds(1), true);
  EXPECT_EQ(radio.states, (States{kNone, kGood, kLost, kDegraded, kGood}));
}

TEST(LinkState, LossOrDelayDegrades) {
  Radio lossy, slow, fair;
  lossy.run(seconds(3), true, 0.11);
  slow.run(seconds(3), true, 0.0, 151.0);
  fair.run(seconds(3), true, 0.10, 150.0);
  EXPECT_EQ(lossy.evaluator.state(), kDegraded);
  EXPECT_EQ(slow.evaluator.state(), kDegraded);
  EXPECT_EQ(fair.evaluator.state(), kGood);
}

TEST(LinkState, ALinkThatFlutersStaysDegraded) {
  Radio radio;
  radio.run(seconds(1), true);
  for (int i = 0; i < 10; ++i) {
    radio.run(seconds(1), true, 0.2);
    radio.run(milliseconds(1'500), true);
  }
  EXPECT_EQ(radio.states, (States{kNone, kGood, kDegraded}));
}

TEST(LinkState, ACarThatWasNeverHeardHasNoLink) {
  Radio radio;
  radio.run(seconds(5), false);
  EXPECT_EQ(radio.evaluator.state(), kNone);
}

}  // namespace
}  // namespace pitwall::state
