// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/race_control.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "protocol/can/av21.hpp"

namespace pitwall::race {
namespace {

namespace av21 = can::av21;
using world::FlagEncoding;
using world::TrackFlag;
using world::VehicleFlag;

struct Sent {
  can::Frame frame;
  Instant at;
};
using Log = std::map<std::uint32_t, std::vector<Sent>>;

Log play(const Script& script, State& state, Duration time, Instant from = {}) {
  Log log;
  for (Instant now = from; now - from < time; now += milliseconds(1))
    for (const can::Frame& f : step(script, state, Timing{}, now)) log[f.id].push_back({f, now});
  return log;
}

Script everything() { return {.both_encodings = true, .positions = true, .calls = {}}; }

std::vector<av21::BaseToCarSummary> summaries(const Log& log) {
  std::vector<av21::BaseToCarSummary> out;
  if (log.count(1200) == 0) return out;
  for (const Sent& s : log.at(1200)) {
    out.emplace_back();
    EXPECT_TRUE(av21::decode(s.frame, out.back()));
  }
  return out;
}

TEST(RaceControl, EveryPeriodIsExact) {
  State state;
  state.changed = false;
  const Log log = play(everything(), state, seconds(10));
  const std::map<std::uint32_t, Duration> periods{
      {1200, milliseconds(500)}, {1250, milliseconds(500)}, {1251, milliseconds(500)},
      {1208, milliseconds(100)}, {1209, milliseconds(100)}, {226, milliseconds(200)},
      {228, milliseconds(200)}};
  ASSERT_EQ(log.size(), periods.size());
  for (const auto& [id, period] : periods) {
    const auto& sent = log.at(id);
    ASSERT_EQ(sent.size(), static_cast<std::size_t>(seconds(10) / period)) << id;
    for (std::size_t i = 1; i < sent.size(); ++i)
      ASSERT_EQ(sent[i].at - sent[i - 1].at, period) << id;
  }
  EXPECT_EQ(state.unsent, 0U);
}

TEST(RaceControl, TheHeartbeatMovesByOneWithEveryFrameAndWrapsAtSixteen) {
  Script script;
  for (int i = 0; i < 40; ++i)  // calls at odd times give extra frames
    script.calls.push_back({.at = Instant{} + milliseconds(333 * i),
                            .track = i % 2 == 0 ? TrackFlag::kGreen : TrackFlag::kYellow,
                            .vehicle = {},
                            .round_target_speed_mph = {},
                            .lap = {}});
  State state;
  const auto beats = summaries(play(script, state, seconds(20)));
  ASSERT_GT(beats.size(), 70U);
  for (std::size_t i = 1; i < beats.size(); ++i) {
    const double expected = static_cast<int>(beats[i - 1].base_to_car_heartbeat + 1) % 16;
    ASSERT_EQ(beats[i].base_to_car_heartbeat, expected) << i;
  }
}

TEST(RaceControl, AChangeIsOnTheBusAtOnceAndOnlyAChangeIs) {
  Script script{.both_encodings = true, .calls = {}};
  const Instant at = Instant{} + milliseconds(1234);
  script.calls.push_back({.at = at,
                          .track = TrackFlag::kGreen,
                          .vehicle = VehicleFlag::kAttacker,
                          .round_target_speed_mph = 125.0,
                          .lap = 7});
  Call same = script.calls.back();
  same.at = at + milliseconds(100);
  script.calls.push_back(same);
  State state;
  const Log log = play(script, state, seconds(3));
  for (const std::uint32_t id : {1200U, 1250U}) {
    const auto& sent = log.at(id);
    const auto hit = [&](Instant t) {
      return std::count_if(sent.begin(), sent.end(), [&](const Sent& s) { return s.at == t; });
    };
    EXPECT_EQ(hit(at), 1) << id;
    EXPECT_EQ(hit(same.at), 0) << id;
  }
  const auto last = summaries(log).back();
  EXPECT_EQ(last.track_flag, 4.0);
  EXPECT_EQ(last.veh_flag, 7.0);
  EXPECT_EQ(last.round_target_speed, 125.0);
  EXPECT_EQ(last.lap_count, 7.0);
}

TEST(RaceControl, WhatIsNotCalledStays) {
  Script script;
  script.calls.push_back({.at = Instant{},
                          .track = TrackFlag::kGreen,
                          .vehicle = VehicleFlag::kDefender,
                          .round_target_speed_mph = 80.0,
                          .lap = {}});
  script.calls.push_back({.at = Instant{} + seconds(1),
                          .track = TrackFlag::kYellow,
                          .vehicle = {},
                          .round_target_speed_mph = {},
                          .lap = {}});
  State state;
  const auto last = summaries(play(script, state, seconds(2))).back();
  EXPECT_EQ(last.track_flag, 3.0);
  EXPECT_EQ(last.veh_flag, 5.0);
  EXPECT_EQ(last.round_target_speed, 80.0);
}

TEST(RaceControl, ACallFromOutsideActsLikeTheScript) {
  State state;
  const Script script;
  play(script, state, seconds(1));
  call(
      state,
      {.at = {}, .track = TrackFlag::kRed, .vehicle = {}, .round_target_speed_mph = {}, .lap = {}});
  const Log log = play(script, state, milliseconds(1), Instant{} + milliseconds(1001));
  ASSERT_EQ(log.count(1200), 1U);
  EXPECT_EQ(summaries(log).back().track_flag, 1.0);
}

TEST(RaceControl, SilenceIsSilenceAndTheGridIsKept) {
  State state;
  const Script script = everything();
  play(script, state, seconds(1));
  state.faults.silent = true;
  EXPECT_TRUE(play(script, state, seconds(3), Instant{} + seconds(1)).empty());
  state.faults.silent = false;
  const Log log = play(script, state, seconds(1), Instant{} + seconds(4));
  for (const RaceFrame& row : kRaceFrames)
    EXPECT_EQ((log.at(row.id).front().at.ns - row.phase.ns) % row.period.ns, 0) << row.id;
}

TEST(RaceControl, AChangeDuringSilenceIsToldAfterwards) {
  State state;
  const Script script;
  play(script, state, seconds(1));
  state.faults.silent = true;
  call(state, {.at = {},
               .track = TrackFlag::kGreen,
               .vehicle = {},
               .round_target_speed_mph = {},
               .lap = {}});
  play(script, state, milliseconds(100), Instant{} + milliseconds(1010));
  state.faults.silent = false;
  EXPECT_EQ(play(script, state, milliseconds(1), Instant{} + milliseconds(1110)).count(1200), 1U);
}

TEST(RaceControl, AStoppedHeartbeatFreezesAndSyncFallsAfterTenSeconds) {
  State state;
  const Script script = everything();
  play(script, state, seconds(1));
  state.faults.heartbeat_stopped = true;
  const Log log = play(script, state, seconds(12), Instant{} + seconds(1));
  const auto beats = summaries(log);
  for (const auto& b : beats) ASSERT_EQ(b.base_to_car_heartbeat, beats[0].base_to_car_heartbeat);
  for (const Sent& s : log.at(1250)) {
    av21::MarelliReport1 m;
    ASSERT_TRUE(av21::decode(s.frame, m));
    const bool fresh = s.at - (Instant{} + seconds(1)) <= seconds(10);
    ASSERT_EQ(m.marelli_rc_base_sync_check, fresh ? 1.0 : 0.0);
  }
}

TEST(RaceControl, LateFlagsAreShownAtOnceInBothEncodingsAfterTheirTime) {
  State state;
  state.faults.late = milliseconds(1300);
  Script script = everything();
  script.calls = {{.at = Instant{} + milliseconds(2100),
                   .track = TrackFlag::kWavingGreen,
                   .vehicle = VehicleFlag::kAttacker,
                   .round_target_speed_mph = 100.0,
                   .lap = {}}};
  const Log log = play(script, state, seconds(6));
  const Instant due = Instant{} + milliseconds(3400);
  for (const Sent& s : log.at(1200)) {
    av21::BaseToCarSummary m;
    ASSERT_TRUE(av21::decode(s.frame, m));
    EXPECT_EQ(m.track_flag == 8.0, s.at >= due) << s.at.seconds();
    EXPECT_EQ(m.round_target_speed == 100.0, s.at >= due);
  }
  for (const Sent& s : log.at(1250)) {
    av21::MarelliReport1 m;
    ASSERT_TRUE(av21::decode(s.frame, m));
    EXPECT_EQ(m.marelli_track_flag == 37.0, s.at >= due);
    EXPECT_EQ(m.marelli_vehicle_flag == 36.0, s.at >= due);
  }
  const auto at_due = [due](const Sent& s) { return s.at == due; };
  EXPECT_TRUE(std::ranges::any_of(log.at(1200), at_due));
  EXPECT_TRUE(std::ranges::any_of(log.at(1250), at_due));
}

TEST(RaceControl, AWrongRoundSpeedReplacesTheCalledOne) {
  State state;
  state.round_target_speed_mph = 80.0;
  state.faults.wrong_speed_mph = 135.0;
  EXPECT_EQ(summaries(play({}, state, seconds(1))).back().round_target_speed, 135.0);
  state.faults = {};
  const Instant later = Instant{} + seconds(1);
  EXPECT_EQ(summaries(play({}, state, seconds(1), later)).back().round_target_speed, 80.0);
}

TEST(RaceControl, BothSystemsSpeakUnlessTheScriptSaysOtherwiseAndFallSilentTogether) {
  State state;
  const Script script;
  Log log = play(script, state, seconds(2));
  for (const std::uint32_t id : {1200u, 1250u, 1251u}) EXPECT_GE(log.count(id), 1U) << id;
  av21::MarelliReport2 position;  // a unit without a fix
  ASSERT_TRUE(av21::decode(log.at(1251).back().frame, position));
  EXPECT_EQ(position.marelli_gps_lat, 0.0);
  state.faults.silent = true;
  EXPECT_TRUE(play(script, state, seconds(2), Instant{} + seconds(2)).empty());
}

TEST(RaceControl, OneEncodingDoesNotSpeakTheOther) {
  State mylaps, marelli;
  const Script by_mylaps{.encoding = FlagEncoding::kMyLaps, .both_encodings = false, .calls = {}};
  const Script by_marelli{.encoding = FlagEncoding::kMarelli, .both_encodings = false, .calls = {}};
  const Log a = play(by_mylaps, mylaps, seconds(2));
  const Log b = play(by_marelli, marelli, seconds(2));
  EXPECT_EQ(a.count(1250) + a.count(1251), 0U);
  EXPECT_EQ(b.count(1200), 0U);
  EXPECT_GT(a.at(1200).size() * b.at(1250).size(), 0U);
}

TEST(RaceControl, TimingAndTheRivalArriveInTheirUnits) {
  State state;
  const Timing timing{.laps = 3,
                      .last_lap_s = 38.5,
                      .rival = Rival{.number = 12, .distance_m = 456.0, .speed_mps = 40.0}};
  av21::BaseToCarTiming lap;
  av21::RestOfField rival;
  int received = 0;
  for (Instant now{}; now - Instant{} < milliseconds(100); now += milliseconds(1))
    for (const can::Frame& f : step({}, state, timing, now))
      received += (av21::decode(f, lap) ? 1 : 0) + (av21::decode(f, rival) ? 1 : 0);
  ASSERT_EQ(received, 2);
  EXPECT_EQ(lap.laps, 3.0);
  EXPECT_NEAR(lap.lap_time, 38'500.0, 0.05);
  EXPECT_EQ(rival.comp_veh_num, 12.0);
  EXPECT_NEAR(from_kmh(rival.comp_speed), 40.0, 0.014);
}

}  // namespace
}  // namespace pitwall::race
