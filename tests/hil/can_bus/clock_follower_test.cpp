// A guest's bench time and that of its host, over the line between them.
// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/clock_follower.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "hil/can_bus/clock_message.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::can_bus {
namespace {

using transport::ClockMemory;
using transport::SerialLine;

struct Host {
  transport::TemporaryFolder folder = *transport::TemporaryFolder::create("pitwall-follower-");
  std::string file = folder.path() + "/clock";
  std::pair<transport::FileDescriptor, transport::FileDescriptor> ends = *transport::stream_pair();
  SerialLine in_guest = *SerialLine::adopt(std::move(ends.first));
  SerialLine on_host = *SerialLine::adopt(std::move(ends.second));
  ClockFollower follower = *ClockFollower::open(file);
  ClockMemory memory = *ClockMemory::open(file);

  Instant now() const { return bench_now(memory.page(), transport::wall_now); }
  // The guest is at this instant; what the host answers.
  std::optional<Instant> at(Instant guest) {
    in_guest.send(encode_clock(guest));
    in_guest.flush();
    follower.serve(on_host);
    const auto word = in_guest.receive();
    return word ? decode_clock(*word) : std::nullopt;
  }
};

constexpr Instant kGuest{5'000'000'000};  // its clock began at another time than the host's

TEST(ClockFollower, TheHostsTimeGoesAsFarAsTheGuestsAndStandsWithIt) {
  Host host;
  EXPECT_EQ(host.at(kGuest), kGuest);
  const Instant first = host.now();
  EXPECT_EQ(host.at(kGuest + seconds(2)), kGuest + seconds(2));
  EXPECT_GE(host.now() - first, milliseconds(1'990));
  transport::nap(milliseconds(60));
  EXPECT_LE(host.now() - first, seconds(2) + 2 * ClockFollower::kLead)
      << "without a word it stands";
}

TEST(ClockFollower, TheAnswerWaitsForWhoIsHeldUpOnTheHost) {
  Host host;
  host.at(kGuest);
  transport::ClockSlot& slot = host.memory.page().slots[3];
  const pid_t base = ::fork();
  if (base == 0) {
    ::pause();
    ::_exit(0);
  }
  slot.thread = base;
  slot.turns = 2;  // waits, and was due long ago
  slot.due_ns = 0;
  slot.process = base;
  const Instant before = host.now();
  EXPECT_EQ(host.at(kGuest + seconds(1)), std::nullopt);
  EXPECT_TRUE(host.follower.is_waiting());
  EXPECT_LE(host.now() - before, ClockFollower::kLead);
  slot.due_ns = INT64_MAX;  // it has done its work and waits again
  host.follower.serve(host.on_host);
  EXPECT_FALSE(host.follower.is_waiting());
  EXPECT_EQ(decode_clock(*host.in_guest.receive()), kGuest + seconds(1));
  EXPECT_GE(host.now() - before, milliseconds(900));
  ::kill(base, SIGKILL);
  ::waitpid(base, nullptr, 0);
}

TEST(ClockFollower, TimeIsFreeAfterTheRunAndInNoStep) {
  Host host;
  host.at(kGuest);
  host.at(Instant::max());
  EXPECT_EQ(host.memory.page().horizon_ns.load(), INT64_MAX);
  const Instant before = host.now();
  EXPECT_EQ(host.at(kGuest - seconds(3)), kGuest - seconds(3)) << "another run, from its beginning";
  EXPECT_GE(host.now(), before);
}

TEST(ClockFollower, TakesNothingThatIsNoInstant) {
  Host host;
  host.in_guest.send(std::vector<std::uint8_t>{1, 2, 3});
  host.in_guest.flush();
  host.follower.serve(host.on_host);
  EXPECT_FALSE(host.in_guest.receive());
  EXPECT_EQ(host.memory.page().horizon_ns.load(), INT64_MAX);
}

}  // namespace
}  // namespace pitwall::can_bus
