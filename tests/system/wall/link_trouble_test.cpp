// What race control is told of a bad radio, by the wall on the real ends of the radio over an
// emulated one, in virtual time: each trouble once when it begins and once when it is over, and
// nothing of what is no trouble.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "hil/link/link_emulator.hpp"
#include "protocol/json/json_value.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall {
namespace {

using telemetry::field;

constexpr Duration kWay = milliseconds(15), kTick = milliseconds(10);

link::LinkParams sound() {
  link::LinkParams params;
  params.delay = kWay;
  return params;
}

struct Notice {
  std::string kind, text, evidence;
};

struct Reported {
  std::vector<Notice> notices;
  int alarms = 0;  // of a lost link, that came
  std::vector<std::string> states;
};

// A car, a wall, and a link each way that is sound but while it is told to be otherwise.
class Pit {
 public:
  Pit(const link::LinkParams& trouble, std::uint64_t seed) {
    for (std::uint64_t way = 0; way < 2; ++way) {
      sound_.emplace_back(sound(), seed + way);
      troubled_.emplace_back(trouble, seed + 2 + way);
    }
    rig_.base->messages().subscribe([this](std::string_view type, std::string_view json, Instant) {
      note(std::string{type}, std::string{json});
    });
    rig_.set(field("mode.mode"), 2.0);
    rig_.set(field("ego.x"), 12.5);
  }

  void run(Duration length, bool trouble) {
    for (const Instant end = rig_.now + length; rig_.now < end; rig_.now += RadioRig::kTick) {
      step(trouble ? troubled_ : sound_);
    }
  }

  const Reported& reported() const { return reported_; }

 private:
  using Ways = std::vector<link::LinkEmulator>;  // to the base, to the car

  void step(Ways& ways) {
    if (rig_.now.ns % kTick.ns == 0) {
      rig_.set(field("radio.loss_0"), rig_.car->report(rig_.now).paths[0].received.loss);
      for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
        if (rig_.sampled.has(row.group)) rig_.snapshot.at(row.group) = rig_.now;
      }
      while (const auto out = rig_.car->poll(rig_.snapshot, rig_.now)) {
        ways[0].offer(out->bytes, rig_.now);
      }
    }
    for (Ways* const from : {&sound_, &troubled_}) deliver(*from);
    if (rig_.now.ns % kTick.ns == 0) rig_.base->advance(rig_.now);
    while (const auto out = rig_.station->poll(rig_.now)) ways[1].offer(out->bytes, rig_.now);
  }

  void deliver(Ways& ways) {
    while (const auto datagram = ways[0].take(rig_.now)) {
      rig_.base->receive(datagram->bytes, 0, RadioRig::kCarAt, rig_.now);
    }
    while (const auto datagram = ways[1].take(rig_.now)) {
      rig_.car->feed(datagram->bytes, 0, RadioRig::kBaseAt, rig_.now);
    }
  }

  // A draft whose words change is told again under its number: the last ones count.
  void note(const std::string& type, const std::string& text) {
    if (type != "notice" && type != "alarm_event" && type != "link") return;
    const auto value = json::JsonValue::parse(text, type);
    ASSERT_TRUE(value);
    if (type == "link") {
      const std::string state = value->text("state");
      if (reported_.states.empty() || reported_.states.back() != state)
        reported_.states.push_back(state);
    } else if (type == "alarm_event") {
      reported_.alarms += value->text("key") == "link_lost" && value->text("to") == "unack" ? 1 : 0;
    } else {
      const auto number = static_cast<std::size_t>(value->number("id"));
      reported_.notices.resize(std::max(reported_.notices.size(), number));
      reported_.notices[number - 1] = {value->text("kind"), value->text("text"),
                                       value->text("evidence")};
    }
  }

  Reported reported_;
  RadioRig rig_;
  Ways sound_, troubled_;
};

Reported reported_of(const link::LinkParams& trouble, Duration length, std::uint64_t seed) {
  Pit pit(trouble, seed);
  pit.run(seconds(6), false);
  pit.run(length, true);
  pit.run(seconds(11), false);
  return pit.reported();
}

void expect_once_each(const Reported& reported) {
  ASSERT_EQ(reported.notices.size(), 2U);
  EXPECT_EQ(reported.notices[0].kind, "degraded");
  EXPECT_EQ(reported.notices[1].kind, "restored");
}

constexpr std::uint64_t kSeeds = 2;

TEST(LinkTrouble, LossIsToldOnceAndItsEndOnce) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    for (const double loss : {0.2, 0.4}) {
      link::LinkParams trouble = sound();
      trouble.loss = loss;
      expect_once_each(reported_of(trouble, seconds(5), seed));
    }
  }
}

TEST(LinkTrouble, ADelayIsToldAsOneAndNothingIsLost) {
  link::LinkParams trouble = sound();
  trouble.delay = milliseconds(300);
  const Reported reported = reported_of(trouble, seconds(5), 1);
  expect_once_each(reported);
  EXPECT_EQ(reported.alarms, 0);
}

TEST(LinkTrouble, AllAtOnceIsOneTrouble) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    link::LinkParams trouble = sound();
    trouble.loss = 0.3;
    trouble.delay = milliseconds(300);
    trouble.reorder = trouble.duplicate = 0.3;
    trouble.reorder_by = milliseconds(70);
    trouble.blackouts = {{Instant{} + seconds(59), seconds(3), {}}};
    const Reported reported = reported_of(trouble, seconds(8), seed);
    expect_once_each(reported);
    EXPECT_EQ(reported.alarms, 1);
  }
}

// Look-alikes: nothing is missing in the end, or too little.
TEST(LinkTrouble, ReorderedRepeatedOrSlightlyLossyIsNoTrouble) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    link::LinkParams reordered = sound(), repeated = sound(), lossy = sound();
    reordered.reorder = 0.3;
    reordered.reorder_by = milliseconds(70);
    repeated.duplicate = 0.5;
    lossy.loss = 0.03;
    for (const link::LinkParams& link : {reordered, repeated, lossy}) {
      const Reported reported = reported_of(link, seconds(5), seed);
      EXPECT_TRUE(reported.notices.empty());
      EXPECT_EQ(reported.alarms, 0);
    }
  }
}

// The words, as race control gets them.
TEST(LinkTrouble, ABlackoutInItsWords) {
  link::LinkParams trouble = sound();
  trouble.loss = 1.0;
  const Reported reported = reported_of(trouble, seconds(3), 1);
  expect_once_each(reported);
  EXPECT_EQ(reported.alarms, 1);
  EXPECT_EQ(reported.states,
            (std::vector<std::string>{"none", "good", "lost", "degraded", "good"}));
  EXPECT_EQ(
      reported.notices[0].text,
      "Radio to our car is lost. Car, when last heard: driving. If the silence lasts it makes "
      "a controlled stop by itself.");
  EXPECT_EQ(reported.notices[0].evidence, "silence 0.41 s, loss 0 %, round trip 30 ms");
  EXPECT_EQ(reported.notices[1].text, "Radio to our car is good again after 9.6 s. Car: driving.");
  EXPECT_EQ(reported.notices[1].evidence,
            "was lost; longest silence 3.02 s, worst loss 76 %, longest round trip 30 ms");
}

}  // namespace
}  // namespace pitwall
