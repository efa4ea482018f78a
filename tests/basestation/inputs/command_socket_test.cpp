// SPDX-License-Identifier: Apache-2.0
#include "basestation/inputs/command_socket.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "protocol/transport/file.hpp"
#include "protocol/transport/readiness.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::inputs {
namespace {

class Commands : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(folder_);
    auto opened = CommandSocket::open(path());
    ASSERT_TRUE(opened) << to_string(opened.error());
    socket_.emplace(*std::move(opened));
    rig_.run(seconds(1));
  }
  std::string path() const { return folder_->path() + "/commands"; }
  transport::LineSocket client() {
    auto connected = transport::LineSocket::connect(path());
    EXPECT_TRUE(connected);
    return *std::move(connected);
  }
  // What is answered to these lines; both ends are of this machine: nothing is on its way for long.
  std::vector<std::string> answers(transport::LineSocket& client,
                                   std::initializer_list<const char*> lines) {
    for (const char* const line : lines) client.send(line);
    std::vector<std::string> answers;
    for (int i = 0; i < 10'000 && answers.size() < lines.size(); ++i) {
      client.flush();
      socket_->serve(rig_.base->requests(), rig_.now);
      for (std::string& line : client.receive()) answers.push_back(std::move(line));
    }
    return answers;
  }
  bool is_ready() const {
    const std::array<int, 1> watched{socket_->fd()};
    return transport::wait_readable(watched, Instant{}) != 0U;
  }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("commands");
  RadioRig rig_;
  std::optional<CommandSocket> socket_;
};

TEST_F(Commands, EveryLineHasItsAnswerInOrder) {
  auto one = client();
  EXPECT_EQ(answers(one, {"take", "fly", "stop controlled"}),
            (std::vector<std::string>{
                "done",
                "refused: not one of stop, release, take, renew, drop, request, grant, refuse, "
                "exclude, admit, command, ack, reset, joystick",
                "done"}));
  EXPECT_EQ(rig_.station->endpoint().stop().state().level, telemetry::StopLevel::kControlled);
}

TEST_F(Commands, OnlyTheOwnerMayUseTheFile) {
  using std::filesystem::perms;
  EXPECT_EQ(std::filesystem::status(path()).permissions() & perms::all,
            perms::owner_read | perms::owner_write);
}

TEST_F(Commands, EachClientIsAnOperatorOfItsOwn) {
  auto one = client(), two = client();
  EXPECT_EQ(answers(one, {"take 5"}), std::vector<std::string>{"done"});
  EXPECT_EQ(answers(two, {"renew"}),
            std::vector<std::string>{"refused: does not hold the authority"});
  EXPECT_EQ(answers(one, {"renew"}), std::vector<std::string>{"done"});
  EXPECT_EQ(socket_->clients(), 2U);
}

TEST_F(Commands, ItWakesForWhoComesAndWhoSpeaksAndForNobodyElse) {
  EXPECT_FALSE(is_ready());
  auto one = client();
  EXPECT_TRUE(is_ready());
  socket_->serve(rig_.base->requests(), rig_.now);
  EXPECT_FALSE(is_ready());
  one.send("take");
  one.flush();
  EXPECT_TRUE(is_ready());
}

TEST_F(Commands, WhoComesAboveTheNumberIsTurnedAwayAndWhoLeavesMakesRoom) {
  std::vector<transport::LineSocket> clients;
  for (std::size_t i = 0; i < CommandSocket::kClients + 1; ++i) {
    clients.push_back(client());
    socket_->serve(rig_.base->requests(), rig_.now);
  }
  EXPECT_EQ(socket_->clients(), CommandSocket::kClients);
  EXPECT_EQ(socket_->turned_away(), 1U);
  clients.clear();
  socket_->serve(rig_.base->requests(), rig_.now);
  EXPECT_EQ(socket_->clients(), 0U);
  auto one = client();
  EXPECT_EQ(answers(one, {"take"}), std::vector<std::string>{"done"});
}

TEST_F(Commands, APathThatIsServedOrCannotBeIsRefused) {
  EXPECT_FALSE(CommandSocket::open(path())) << "somebody serves it";
  EXPECT_FALSE(CommandSocket::open("/proc/nowhere/commands"));
}

}  // namespace
}  // namespace pitwall::inputs
