// SPDX-License-Identifier: Apache-2.0
#include "basestation/replay/player.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "protocol/transport/file.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::replay {
namespace {

using testing::Console;
using testing::kRaceStart;
using testing::Race;

class Replay : public ::testing::Test {
 protected:
  static constexpr Duration kLength = seconds(45);

  void SetUp() override {
    testing::record_race(folder_->path(), kLength);
    auto opened = Player::open(folder_->path());
    ASSERT_TRUE(opened) << to_string(opened.error());
    player_.emplace(*std::move(opened));
  }
  // What the live base knew then.
  static Console live_at(Instant at) {
    Console console;
    Race{}.go_to(at, console);
    return console;
  }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall_replay");
  std::optional<Player> player_;
};

TEST_F(Replay, PlayedForwardItIsTheLivePictureAtEveryMoment) {
  Console console;
  EXPECT_EQ(player_->begin(), kRaceStart);
  EXPECT_EQ(player_->end(), kRaceStart + kLength);
  Console live;
  Race race;
  while (!player_->ended()) {
    player_->advance(milliseconds(730), console);
    race.go_to(player_->now(), live);
    testing::expect_same(console.vehicle, live.vehicle, player_->now());
  }
  EXPECT_EQ(console.texts, live.texts);
  EXPECT_EQ(console.restarts, 0);
  EXPECT_TRUE(player_->problems().empty());
}

TEST_F(Replay, AfterAJumpAnywhereItIsTheLivePictureOfThatMoment) {
  Console console;
  for (const std::int64_t at_ms : {44'990, 3'000, 20'010, 19'990, 41'000, 0, 25'555, 10, 12'345}) {
    const Instant at = kRaceStart + milliseconds(at_ms);
    player_->jump(at, console);
    EXPECT_EQ(player_->now(), at);
    const Console live = live_at(at);
    testing::expect_same(console.vehicle, live.vehicle, at);
    std::vector<std::string> audit;
    for (const std::string& text : live.texts) {
      if (text.starts_with("audit") || text == *(live.texts.end() - 1)) audit.push_back(text);
    }
    EXPECT_EQ(console.texts, audit) << at_ms;  // all of a log, the newest of a state
    // And it goes on from there.
    player_->advance(milliseconds(500), console);
    testing::expect_same(console.vehicle, live_at(player_->now()).vehicle, player_->now());
  }
}

TEST_F(Replay, SpeedIsRecordedTimePerTimeThatPasses) {
  Console console;
  for (const double speed : {0.1, 1.0, 20.0}) {
    player_->jump(kRaceStart, console);
    player_->set_speed(speed);
    player_->advance(seconds(2), console);
    EXPECT_NEAR((player_->now() - kRaceStart).seconds(), 2.0 * speed, 1e-6);
  }
  player_->set_speed(0.0);
  const Instant paused = player_->now();
  player_->advance(seconds(60), console);
  EXPECT_EQ(player_->now(), paused);
  player_->set_speed(1e9);
  EXPECT_EQ(player_->speed(), kFastest);
  player_->set_speed(-0.01);
  EXPECT_EQ(player_->speed(), -kSlowest);
  player_->set_speed(kUnset);
  EXPECT_EQ(player_->speed(), -kSlowest);
}

TEST_F(Replay, BackwardsItIsTheLivePictureToo) {
  Console console;
  player_->jump(kRaceStart + seconds(25), console);
  player_->set_speed(-2.0);
  for (int i = 0; i < 20; ++i) {
    player_->advance(milliseconds(200), console);
    testing::expect_same(console.vehicle, live_at(player_->now()).vehicle, player_->now());
  }
  EXPECT_NEAR((player_->now() - kRaceStart).seconds(), 17.0, 0.2);
  player_->advance(seconds(600), console);
  EXPECT_EQ(player_->now(), player_->begin());
}

TEST_F(Replay, ASegmentThatIsCutOrMissingIsPlayedAsFarAsItGoes) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator{folder_->path()}) {
    paths.push_back(entry.path().string());
  }
  std::ranges::sort(paths);
  ASSERT_EQ(paths.size(), 3U);
  std::filesystem::resize_file(paths[0], std::filesystem::file_size(paths[0]) / 2);
  std::filesystem::remove(paths[1]);
  ASSERT_TRUE(transport::write_file(folder_->path() + "/other.mcap", "nothing"));
  auto player = Player::open(folder_->path());
  ASSERT_TRUE(player);
  EXPECT_EQ(player->problems().size(), 1U);
  Console console;
  player->advance(seconds(60), console);
  EXPECT_EQ(player->now(), kRaceStart + kLength);
  testing::expect_same(console.vehicle, live_at(player->now()).vehicle, player->now());
}

TEST(Player, AFolderWithoutARecordingIsRefused) {
  const auto folder = transport::TemporaryFolder::create("pitwall_replay");
  EXPECT_FALSE(Player::open(folder->path()));
  EXPECT_FALSE(Player::open(folder->path() + "/none"));
}

}  // namespace
}  // namespace pitwall::replay
