// How far commands move where a run's inputs come a tick or two later: what the tolerances of a
// comparison with a live run stand on, shown in lockstep, where nothing else can move.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/bench/recorded/command_comparison.hpp"
#include "hil/bench/recorded/drive_again.hpp"
#include "hil/sensors/receiver_bytes.hpp"
#include "protocol/can/decode.hpp"
#include "protocol/vocabulary/random.hpp"
#include "tests/hil/bench/recorded/recorded_drive.hpp"
#include "vehicle/io/tick_inputs.hpp"

namespace pitwall::bench {
namespace {

using Ticks = std::vector<RecordedTick>;
constexpr std::size_t kStarted = 2'000;  // ticks: the car was let go and shifts up

// A start, a drive and a stop, with what each tick was given.
struct Drive {
  pipeline::Setup setup;
  Ticks ticks;
  CommandTolerances tolerances;
};

const Drive& drive() {
  static const Drive driven = [] {
    const std::string root = PITWALL_SOURCE_DIR;
    const Loaded loaded = *load(root + "/hil/scenarios/launch_and_stop.yaml", root);
    Ticks ticks;
    sensors::ReceiverEncoders encoders{loaded.setup.params.receivers};
    const auto step = [&](const pipeline::Setup& setup, pipeline::Car& car,
                          const pipeline::Inputs& in) {
      RecordedTick tick;
      tick.now = in.now;
      tick.given = io::record_of(in, {.number = ticks.size()});
      tick.received.assign(in.can.begin(), in.can.end());
      encoders.encode(in.sensors, [&](std::uint8_t unit, std::span<const std::uint8_t> bytes) {
        tick.receivers.push_back({unit, in.now, {bytes.begin(), bytes.end()}});
      });
      ticks.push_back(std::move(tick));
      return pipeline::step(setup, car, in);
    };
    EXPECT_TRUE(run_lockstep(loaded.scenario, loaded.setup, {.step = step}));
    return Drive{loaded.setup, std::move(ticks),
                 tolerances_of(loaded.setup.params, own_database())};
  }();
  return driven;
}

void move(std::int64_t& at_ns, Duration by) {
  if (at_ns != recorder::kNever) at_ns += by.ns;
}

// All that comes from outside comes `by` ticks later; the ticks stay where they are.
Ticks moved(const Ticks& ticks, std::size_t by) {
  const Duration late = kTick * static_cast<std::int64_t>(by);
  Ticks out(ticks.size());
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    RecordedTick& tick = out[i];
    if (i >= by) tick = ticks[i - by];
    tick.now = ticks[i].now;
    for (can::ReceivedFrame& frame : tick.received) frame.at += late;
    for (ReceiverBytes& some : tick.receivers) some.at += late;
    for (std::int64_t* at_ns : {&tick.given.joystick_at_ns, &tick.given.gnss0_byte_at_ns,
                                &tick.given.gnss1_byte_at_ns, &tick.given.radio_at_ns})
      move(*at_ns, late);
    tick.given.number = i;
    tick.given.dt_ns = ticks[i].given.dt_ns;
    tick.given.requests = ticks[i].given.requests;
  }
  return out;
}

// Of each tick the last frames and bytes come just after it: the next one has them.
Ticks scattered(const Ticks& ticks, std::uint64_t seed) {
  Random random{seed};
  Ticks out = ticks;
  const auto give = [&](auto& from, auto& to, Instant at) {
    const auto kept = static_cast<std::ptrdiff_t>(random.below(from.size() + 1));
    std::for_each(from.begin() + kept, from.end(), [&](auto& some) { some.at = at; });
    to.insert(to.begin(), from.begin() + kept, from.end());
    from.erase(from.begin() + kept, from.end());
  };
  for (std::size_t i = out.size() - 1; i-- > 0;) {  // from behind: nothing moves twice
    give(out[i].received, out[i + 1].received, out[i].now + microseconds(1));
    give(out[i].receivers, out[i + 1].receivers, out[i].now + microseconds(1));
  }
  return out;
}

CommandTrace trace_of(const pipeline::Setup& setup, const Ticks& ticks) {
  CommandTrace out;
  DriveAgain car{setup};
  std::vector<double> values;
  for (const RecordedTick& tick : ticks) {
    out.length = tick.now - ticks.front().now;
    const auto again = car.tick(tick);
    EXPECT_TRUE(again) << to_string(again.error());
    for (const can::Frame& frame : again->sent) {
      for (std::size_t i = 0; i < kActuators; ++i) {
        const can::Message& message = *own_database().find(kCommandSignals[i].message);
        if (frame.id != message.id) continue;
        values.resize(message.signals.size());
        EXPECT_TRUE(can::decode(message, frame, values));
        const std::size_t signal = *message.index_of(kCommandSignals[i].signal);
        out.commands[i].push_back({out.length, values[signal]});
      }
    }
  }
  return out;
}

std::size_t phases_of(const pipeline::Setup& setup) {
  return static_cast<std::size_t>(setup.params.rates.planning.ns / kTick.ns);
}

// Inputs that are 0, 1, ... ticks late: every phase to the plans, and each moved by two ticks.
std::vector<CommandTrace> traces_of(const pipeline::Setup& setup) {
  std::vector<CommandTrace> out;
  for (std::size_t late = 0; late < phases_of(setup) + CommandTolerances::kLagTicks; ++late)
    out.push_back(trace_of(setup, moved(drive().ticks, late)));
  return out;
}

// Whether no command of the one run is further than `lag` from its like in the other.
bool is_within(Duration lag, const CommandTrace& one, const CommandTrace& other) {
  CommandTolerances here = drive().tolerances;
  here.planning = lag - here.lag();
  return compare(one, other, here).differences.empty();
}

pipeline::Setup planning_in_every_tick() {
  pipeline::Setup setup = drive().setup;
  setup.params.rates.planning = setup.params.rates.tick;
  return setup;
}

// As it is, every phase to the plans, against some inputs of it a tick later.
void expect_scattered_within(Duration lag, const pipeline::Setup& setup) {
  for (std::size_t phase = 0; phase < phases_of(setup); ++phase) {
    Ticks given = moved(drive().ticks, phase);
    given.resize(kStarted);
    const CommandTrace as_given = trace_of(setup, given);
    for (const std::uint64_t seed : {1U, 2U})
      EXPECT_TRUE(is_within(lag, as_given, trace_of(setup, scattered(given, seed))))
          << phase << " ticks late, seed " << seed;
  }
}

TEST(MovedInputs, MoveCommandsByAsMuchAndAPlanningPeriodAtMost) {
  const std::vector<CommandTrace> traces = traces_of(drive().setup);
  const Duration planning = drive().setup.params.rates.planning;
  std::size_t beyond_two_ticks = 0, pairs = 0;
  ASSERT_EQ(phases_of(drive().setup), 5U);
  for (std::size_t phase = 0; phase < phases_of(drive().setup); ++phase) {
    for (const std::size_t by : {1U, 2U}) {
      const CommandTrace &one = traces[phase], &other = traces[phase + by];
      ASSERT_GT(one.commands[0].size(), 3'000U);
      EXPECT_TRUE(is_within(kTick * static_cast<std::int64_t>(by) + planning, one, other))
          << "from " << phase << " ticks late, " << by << " more";
      beyond_two_ticks += is_within(drive().tolerances.lag(), one, other) ? 0U : 1U;
      ++pairs;
    }
  }
  EXPECT_GT(beyond_two_ticks, 0U) << "two ticks would do";
  EXPECT_LE(beyond_two_ticks, pairs / 2) << "of what crosses no plan's tick";
}

TEST(MovedInputs, MoveCommandsByAsMuchWhereTheCarPlansInEveryTick) {
  const std::vector<CommandTrace> traces = traces_of(planning_in_every_tick());
  ASSERT_EQ(traces.size(), 3U) << "there is one phase";
  for (const std::size_t by : {1U, 2U})
    EXPECT_TRUE(is_within(kTick * static_cast<std::int64_t>(by), traces[0], traces[by]))
        << by << " ticks late";
}

TEST(MovedInputs, SomeThatComeATickLaterMoveCommandsByATickAndAPlanningPeriodAtMost) {
  expect_scattered_within(kTick + drive().setup.params.rates.planning, drive().setup);
}

TEST(MovedInputs, SomeThatComeATickLaterMoveThemByATickWhereTheCarPlansInEveryTick) {
  expect_scattered_within(kTick, planning_in_every_tick());
}

}  // namespace
}  // namespace pitwall::bench
