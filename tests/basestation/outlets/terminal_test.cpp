// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/terminal.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/basestation/sender.hpp"

namespace pitwall::outlets {
namespace {

std::string contents(std::FILE* file) {
  std::rewind(file);
  std::string text;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
  return text;
}

class Terminal : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(socket_ && sender_ && file_ != nullptr);
    ASSERT_EQ(::pipe(stop_), 0);
  }
  void TearDown() override {
    if (file_ != nullptr) std::fclose(file_);
    for (const int fd : stop_) ::close(fd);
  }
  void send(std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      ASSERT_TRUE(sender_->send_to(socket_->local(), car_.bytes(i)));
    }
  }
  std::string run(const TerminalOptions& options) {
    run_terminal(*socket_, stop_[0], options, *station_, file_);
    return contents(file_);
  }

  Result<transport::UdpSocket, Problem> socket_ = transport::UdpSocket::bind({});
  Result<transport::UdpSocket, Problem> sender_ = transport::UdpSocket::bind({});
  std::FILE* file_ = std::tmpfile();
  int stop_[2] = {-1, -1};
  Sender car_;
  std::unique_ptr<intake::Station> station_ = std::make_unique<intake::Station>(1);
};

TEST_F(Terminal, TakesWhatWaitsBeforeItStops) {
  send(100);
  ASSERT_EQ(::write(stop_[1], "x", 1), 1);
  const std::string screens = run({.text = true, .plain = true});
  EXPECT_EQ(station_->counters().accepted, 100U);
  EXPECT_NE(screens.find("REAL CAR"), std::string::npos);
  EXPECT_EQ(screens.find('\x1b'), std::string::npos);
}

TEST_F(Terminal, StopsByItselfAndIsSilentUnlessAsked) {
  EXPECT_EQ(run({.duration = milliseconds(30)}), "");
  EXPECT_EQ(station_->counters().received, 0U);
}

// The peer is a socket of the test; what the bytes mean is the heartbeat's own test.
TEST_F(Terminal, AnswersTheSenderOfTheLastAcceptedPacketAndNobodyElse) {
  auto stranger = transport::UdpSocket::bind({});
  ASSERT_TRUE(stranger);
  send(3);
  ASSERT_TRUE(stranger->send_to(socket_->local(), std::vector<std::uint8_t>(60, 0x50)));
  run({.duration = milliseconds(350)});
  std::vector<transport::UdpDatagram> heard(32);
  const std::size_t count = sender_->receive(heard);
  EXPECT_GE(count, 1U);
  EXPECT_LE(count, 4U) << "one at once, then one each 100 ms";
  EXPECT_EQ(count, station_->uplink().counters().sent);
  for (std::size_t i = 0; i < count; ++i) {
    const auto heartbeat = telemetry::parse_heartbeat(heard[i].payload());
    ASSERT_TRUE(heartbeat);
    EXPECT_EQ(heartbeat->heard_sequence, 2U);
    EXPECT_EQ(heartbeat->sequence, i);
  }
  EXPECT_EQ(stranger->receive(heard), 0U);
}

TEST_F(Terminal, SaysNothingBeforeACarWasHeard) {
  run({.duration = milliseconds(250)});
  EXPECT_EQ(socket_->counters().sent, 0U);
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
