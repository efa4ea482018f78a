// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/foxglove_replay.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/publishers/foxglove/viewer.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::publishers::foxglove {
namespace {

std::uint64_t number_at(const std::string& bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = count; i-- > 0;)
    value = value << 8U | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}

struct Reported {
  int status;
  std::int64_t at_ns;
  float speed;
  bool did_seek;
  std::string request;
};
Reported reported(const std::string& bytes) {
  return {bytes.at(1), static_cast<std::int64_t>(number_at(bytes, 2, 8)),
          std::bit_cast<float>(static_cast<std::uint32_t>(number_at(bytes, 10, 4))),
          bytes.at(14) != 0, bytes.substr(19)};
}

std::string control(bool play, float speed, std::optional<std::int64_t> seek,
                    const std::string& request) {
  std::string bytes{'\3', play ? '\0' : '\1'};
  const auto put = [&bytes](std::uint64_t number, int count) {
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>(number >> (8 * i)));
  };
  put(std::bit_cast<std::uint32_t>(speed), 4);
  put(seek ? 1 : 0, 1);
  put(static_cast<std::uint64_t>(seek.value_or(0)), 8);
  put(request.size(), 4);
  return bytes + request;
}

class FoxgloveReplays : public testing::Test {
 protected:
  void SetUp() override {
    replay::testing::record_race(folder_->path(), seconds(6));
    player_.emplace(*replay::Player::open(folder_->path()));
    auto started = FoxgloveReplay::start({.name = "Pitwall"}, *player_);
    ASSERT_TRUE(started);
    replay_ = *std::move(started);
    ASSERT_EQ(viewer_.open(replay_->local().port), 101u);
    while (replay_->figures().clients == 0) turn({});
  }
  void turn(Duration passed) {
    player_->advance(passed, *replay_);
    now_ += milliseconds(40);
    replay_->serve(
        *player_,
        [this](double speed, std::optional<Instant> to) {
          player_->set_speed(speed);
          if (to) player_->jump(*to, *replay_);
        },
        now_);
  }
  // Turns of no length until the state that answers a request has come.
  Reported ask(const std::string& bytes, const std::string& request) {
    viewer_.web_client().send_bytes(bytes);
    for (int i = 0; i < 1'000; ++i) {
      now_ += seconds(1);  // so that each turn tells a state
      turn({});
      const Reported state = reported(viewer_.bytes(5));
      if (state.request == request) return state;
    }
    ADD_FAILURE() << "no answer";
    return {};
  }
  std::int64_t utc_ns(Instant at) const { return player_->clock().to_file(at).ns; }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall_foxglove");
  std::optional<replay::Player> player_;
  std::unique_ptr<FoxgloveReplay> replay_;
  Viewer viewer_;
  Instant now_{seconds(100).ns};
};

TEST_F(FoxgloveReplays, ARecordingIsServedWithItsRangeAndItsOwnTime) {
  viewer_.channels();
  EXPECT_EQ(viewer_.info().items("capabilities").back().text(), "playbackControl");
  const auto* const begin = viewer_.info().find("dataStartTime");
  ASSERT_NE(begin, nullptr);
  EXPECT_EQ(begin->number("sec"),
            static_cast<double>(utc_ns(player_->begin()) / kNanosecondsPerSecond));
}

TEST_F(FoxgloveReplays, AClientPausesJumpsAndPlaysFaster) {
  const Reported paused = ask(control(false, 1.0F, std::nullopt, "a"), "a");
  EXPECT_EQ(paused.status, static_cast<int>(PlaybackStatus::kPaused));
  const Instant to = player_->begin() + seconds(3);
  const Reported jumped = ask(control(true, 2.0F, utc_ns(to), "b"), "b");
  EXPECT_EQ(jumped.status, static_cast<int>(PlaybackStatus::kPlaying));
  EXPECT_TRUE(jumped.did_seek);
  EXPECT_EQ(jumped.speed, 2.0F);
  EXPECT_EQ(jumped.at_ns, utc_ns(to));
  turn(seconds(1));
  EXPECT_EQ(player_->now(), to + seconds(2));
  turn(seconds(5));
  EXPECT_TRUE(player_->ended());
  const Reported ended = ask(control(true, 2.0F, std::nullopt, "c"), "c");
  EXPECT_EQ(ended.status, static_cast<int>(PlaybackStatus::kEnded));
}

TEST_F(FoxgloveReplays, ATimeBeyondTheRecordingIsItsEnd) {
  const Reported state = ask(control(false, 1.0F, INT64_MAX, "x"), "x");
  EXPECT_EQ(player_->now(), player_->end());
  EXPECT_EQ(state.at_ns, utc_ns(player_->end()));
}

}  // namespace
}  // namespace pitwall::publishers::foxglove
