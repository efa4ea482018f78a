// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/terminal.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "basestation/intake/key_pair.hpp"
#include "protocol/telemetry/endpoint/car_endpoint.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::outlets {
namespace {

std::string contents(std::FILE* file) {
  std::rewind(file);
  std::string text;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
  return text;
}

class Terminal : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(radio_.front() && car_socket_ && words_ && file_ != nullptr);
    ASSERT_EQ(::pipe(stop_), 0);
    telemetry::ConduitConfig config;
    config.association.keys = keys_.base;
    station_ = std::make_unique<intake::Station>(config, randomness_);
  }
  void TearDown() override {
    if (file_ != nullptr) std::fclose(file_);
    for (const int fd : stop_) ::close(fd);
  }
  std::string run(const TerminalOptions& options) {
    const Lines car{.station = station_.get(),
                    .title = "car 7",
                    .radio = {&*radio_.front(), 1},
                    .words = &*words_,
                    .script = &script_};
    run_terminal({&car, 1}, options, stop_[0], file_);
    return contents(file_);
  }
  // A car that speaks from another thread until the loop has ended.
  std::string run_with_car(const TerminalOptions& options) {
    std::atomic<bool> over = false;
    std::thread car([&] { drive(over); });
    const std::string text = run(options);
    over = true;
    car.join();
    return text;
  }
  void drive(const std::atomic<bool>& over) {
    telemetry::SeededRandomness randomness(3);
    telemetry::ConduitConfig config;
    config.association.keys = keys_.car;
    config.association.greeting.real_car = true;
    const transport::UdpAddress base = radio_.front()->local();
    config.association.peer[0] = {.ip = base.ip, .port = base.port};
    telemetry::CarEndpoint car(config, randomness);
    telemetry::Snapshot snapshot;
    snapshot.values[telemetry::field("ego.x")] = 12.0;
    std::vector<transport::UdpDatagram> batch(8);
    while (!over) {
      const Instant now = transport::monotonic_now();
      const std::size_t n = car_socket_->receive(batch);
      for (std::size_t i = 0; i < n; ++i) {
        car.feed(batch[i].payload(), 0, {.ip = batch[i].from.ip, .port = batch[i].from.port},
                 batch[i].at);
      }
      snapshot.at(telemetry::Group::kEgo) = now;
      while (const auto out = car.poll(snapshot, now)) {
        car_socket_->send_to({.ip = out->to.ip, .port = out->to.port}, out->bytes);
      }
      const int watched[] = {car_socket_->fd()};
      transport::wait_readable(watched, now + milliseconds(2));
    }
  }

  telemetry::SeededRandomness randomness_{1};
  intake::KeyPair keys_ = intake::make_key_pair(randomness_);
  std::vector<Result<transport::UdpSocket, Problem>> radio_ = [] {
    std::vector<Result<transport::UdpSocket, Problem>> sockets;
    sockets.push_back(transport::UdpSocket::bind({}));
    return sockets;
  }();
  Result<transport::UdpSocket, Problem> car_socket_ = transport::UdpSocket::bind({});
  Result<transport::UdpSocket, Problem> words_ = transport::UdpSocket::bind({});
  intake::OperatorScript script_;
  std::FILE* file_ = std::tmpfile();
  int stop_[2] = {-1, -1};
  std::unique_ptr<intake::Station> station_;
};

TEST_F(Terminal, MeetsTheCarAndShowsWhatItSays) {
  const std::string screens =
      run_with_car({.text = true, .plain = true, .duration = milliseconds(600)});
  EXPECT_NE(screens.find("REAL CAR"), std::string::npos);
  EXPECT_NE(screens.find("x: 12.0"), std::string::npos);
  EXPECT_EQ(screens.find('\x1b'), std::string::npos);
  EXPECT_GT(station_->rate().packets(), 3U);
}

TEST_F(Terminal, SaysTheScriptAndWhatComesByTheWordsSocket) {
  script_ = *intake::OperatorScript::parse("0.1 stop controlled\n", "f");
  const std::string word = "take 9\n";
  auto operator_socket = transport::UdpSocket::bind({});
  ASSERT_TRUE(operator_socket);
  operator_socket->send_to(words_->local(),
                           {reinterpret_cast<const std::uint8_t*>(word.data()), word.size()});
  run_with_car({.duration = milliseconds(600)});
  EXPECT_EQ(station_->endpoint().authority().holder(transport::monotonic_now()), 9);
  EXPECT_EQ(station_->endpoint().stop().state().level, telemetry::StopLevel::kControlled);
}

TEST_F(Terminal, StopsByItselfAndIsSilentUnlessAsked) {
  EXPECT_EQ(run({.duration = milliseconds(30)}), "");
  EXPECT_EQ(station_->rate().packets(), 0U);
}

// A base without a screen has its log; a flood is one line of it.
TEST_F(Terminal, AttacksAreALineOnStandardErrorWhereThereIsNoScreen) {
  const std::vector<std::uint8_t> noise(30, 0xFF);
  for (const bool text : {false, true}) {
    station_ = std::make_unique<intake::Station>(
        telemetry::ConduitConfig{.association = {.keys = keys_.base}}, randomness_);
    for (int i = 0; i < 150; ++i) car_socket_->send_to(radio_.front()->local(), noise);
    ::testing::internal::CaptureStderr();
    run({.text = text, .plain = true, .duration = milliseconds(300)});
    EXPECT_EQ(::testing::internal::GetCapturedStderr(),
              text ? ""
                   : "pitwall-base: car 7: radio, seen by the base: Forged or foreign datagrams "
                     "come at rate; all are refused\n");
  }
}

TEST_F(Terminal, StopsWhenItIsTold) {
  ASSERT_EQ(::write(stop_[1], "x", 1), 1);
  EXPECT_NE(run({.text = true, .plain = true}).find("waiting for the first packet"),
            std::string::npos);
}

TEST_F(Terminal, SaysNothingBeforeACarWasHeard) {
  run({.duration = milliseconds(250)});
  EXPECT_EQ(radio_.front()->counters().sent, 0U);
}

TEST_F(Terminal, SeveralCarsStandBelowEachOtherOnOneScreen) {
  telemetry::ConduitConfig config;
  config.association.keys = intake::make_key_pair(randomness_).base;
  intake::Station second{config, randomness_};
  std::array<Lines, 2> cars;
  cars[0].station = station_.get(), cars[0].title = "CAR 7";
  cars[1].station = &second, cars[1].title = "CAR 8";
  run_terminal(cars, {.text = true, .duration = milliseconds(1)}, stop_[0], file_);
  const std::string screens = contents(file_);
  const auto count = [&](std::string_view what) {
    std::size_t times = 0;
    for (std::size_t at = 0; (at = screens.find(what, at)) != std::string::npos; ++at) ++times;
    return times;
  };
  EXPECT_GE(count("CAR 7"), 1U);
  EXPECT_EQ(count("CAR 7"), count("CAR 8"));
  EXPECT_EQ(count("\x1b[H"), count("CAR 7")) << "the cursor goes home once for both";
  EXPECT_LT(screens.find("CAR 7"), screens.find("CAR 8"));
}

TEST_F(Terminal, RefreshesTheScreen) {
  const std::string screens =
      run({.text = true, .duration = seconds(1), .refresh = milliseconds(5)});
  std::size_t count = 0;
  for (std::size_t at = 0; (at = screens.find("\x1b[H", at)) != std::string::npos; ++at) ++count;
  EXPECT_GE(count, 3U);
}

}  // namespace
}  // namespace pitwall::outlets
