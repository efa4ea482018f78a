// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/recorded/recording_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "basestation/replay/player.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/oval_course.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::service {
namespace {

using telemetry::Group;

// A car that drives around a course at 50 m/s, from its line on, ten seconds of silence included.
class Driven {
 public:
  Driven(const state::Course& course, Duration silence_from)
      : length_m_(course.length_m()), silence_from_(silence_from) {}

  void go_to(Duration to, replay::Listener& listener) const {
    telemetry::GroupSet groups;
    groups.add(Group::kTrack);
    groups.add(Group::kEgo);
    for (Duration at{}; at <= to; at = at + replay::testing::kPacket) {
      if (at > silence_from_ && at < silence_from_ + seconds(10)) continue;
      telemetry::Snapshot state;
      const Instant now = replay::testing::kRaceStart + at;
      state.at(Group::kTrack) = state.at(Group::kEgo) = now - milliseconds(10);
      state.values[telemetry::field("track.station")] =
          std::fmod(length_m_ - 10.0 + 50.0 * at.seconds(), length_m_);
      state.values[telemetry::field("ego.vx")] = 50.0;
      listener.state(state, groups, now);
    }
  }

 private:
  double length_m_;
  Duration silence_from_;
};

class Indexed : public ::testing::Test {
 protected:
  static constexpr Duration kLength = seconds(150);
  static constexpr Duration kSilence = seconds(70);

  void SetUp() override {
    replay::testing::Recording recording{folder_->path()};
    Driven{course_, kSilence}.go_to(kLength, recording);
  }

  state::Course course_ = Oval{}.course();
  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall_index");
  RecordingIndex index_{course_};
};

TEST_F(Indexed, TheLapsAreThereAsSoonAsItIsOpen) {
  const auto player = replay::Player::open(folder_->path(), &index_);
  ASSERT_TRUE(player);
  EXPECT_EQ(player->now(), player->begin()) << "nothing was played";
  const double lap_s = course_.length_m() / 50.0;
  const auto& laps = index_.laps()->laps();
  ASSERT_GE(laps.size(), 3U);
  std::size_t complete = 0;
  for (const state::Lap& lap : laps) {
    if (!lap.complete()) continue;
    ++complete;
    EXPECT_NEAR(lap.time_s(), lap_s, 1e-6);
  }
  EXPECT_GT(complete, 0U);
  // Those that the live base would have, had it gone on so long.
  state::LapLog live{course_.length_m()};
  struct Live : replay::Listener {
    explicit Live(state::LapLog& log) : log_(log) {}
    void state(const telemetry::Snapshot& s, telemetry::GroupSet groups, Instant) override {
      log_.note(s, groups);
    }
    void text(recorder::Topic, Instant, std::string_view) override {}
    void restart(Instant) override {}
    state::LapLog& log_;
  } listener{live};
  Driven{course_, kSilence}.go_to(kLength, listener);
  ASSERT_EQ(live.laps().size(), laps.size());
  for (std::size_t i = 0; i < laps.size(); ++i) {
    EXPECT_EQ(live.laps()[i].begin, laps[i].begin);
    EXPECT_EQ(live.laps()[i].end, laps[i].end);
    EXPECT_EQ(live.laps()[i].gap, laps[i].gap);
  }
}

TEST_F(Indexed, TheHistoryIsThatOfTheWholeRecordingWithItsGap) {
  ASSERT_TRUE(replay::Player::open(folder_->path(), &index_));
  const auto speed = telemetry::field("ego.vx");
  const Instant begin = replay::testing::kRaceStart;
  const auto all = index_.trends().range(speed, begin - seconds(1), begin + kLength, 20'000);
  ASSERT_GT(all.size(), 500U);
  EXPECT_NEAR(all.front().time_s, 1'000.0 - 0.01, 1e-6);
  EXPECT_NEAR(all.back().time_s, 1'150.0 - 0.01, 0.2);
  const auto lost = std::ranges::find_if(all, [](const auto& p) { return std::isnan(p.value); });
  ASSERT_NE(lost, all.end());
  EXPECT_NEAR(lost->time_s, 1'070.0, 1.0);
  EXPECT_NEAR((lost + 1)->time_s, 1'080.0, 0.2);
}

TEST_F(Indexed, WithoutACourseThereAreNoLaps) {
  RecordingIndex none{std::nullopt};
  ASSERT_TRUE(replay::Player::open(folder_->path(), &none));
  EXPECT_EQ(none.laps(), nullptr);
}

}  // namespace
}  // namespace pitwall::service
