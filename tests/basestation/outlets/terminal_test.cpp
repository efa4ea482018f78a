// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/terminal.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <string>

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
  std::unique_ptr<intake::Station> station_ = std::make_unique<intake::Station>();
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

TEST_F(Terminal, RefreshesTheScreen) {
  const std::string screens =
      run({.text = true, .duration = seconds(1), .refresh = milliseconds(5)});
  std::size_t count = 0;
  for (std::size_t at = 0; (at = screens.find("\x1b[H", at)) != std::string::npos; ++at) ++count;
  EXPECT_GE(count, 3U);
}

}  // namespace
}  // namespace pitwall::outlets
