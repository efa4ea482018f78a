// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/recorder.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <new>
#include <random>

#include "protocol/recorder/segment_folder.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "tests/support/oracle_node.hpp"

namespace pitwall::recorder {
namespace {

telemetry::GroupSet all_groups() { return telemetry::groups_of(telemetry::Direction::kDown); }

telemetry::Snapshot sampled_at(Instant at) {
  telemetry::Snapshot state;
  state.sampled_at.fill(at);
  for (std::size_t i = 0; i < telemetry::kFieldCount; ++i) {
    state.values[i] = static_cast<double>(i);
  }
  return state;
}

TEST(Recorder, TheOracleReadsEverythingThatWasGiven) {
  NEEDS_ORACLES();
  const auto folder = transport::TemporaryFolder::create("pitwall_recorder");
  const Instant now = transport::monotonic_now();
  {
    auto recorder = Recorder::start(folder->path(), {{"car", "7"}});
    ASSERT_TRUE(recorder);
    for (int i = 0; i < 100; ++i) {
      const Instant at = now + milliseconds(20) * i;
      (*recorder)->state(sampled_at(at - milliseconds(5)), all_groups(), at);
      (*recorder)->datagram(true, at, {.path = 1, .bytes = as_bytes("bytes of the air")});
      (*recorder)->receiver(1, at, as_bytes("bytes of a receiver"));
    }
    (*recorder)->text(Topic::kMark, now + seconds(1), R"({"type":"mark","text":"here"})");
  }
  const auto paths = segments_of(folder->path());
  ASSERT_TRUE(paths);
  ASSERT_EQ(paths->size(), 1U);
  const std::string line = pitwall::testing::node("check_mcap.mjs", "'" + paths->front() + "'");
  const std::uint64_t messages = 100 * (all_groups().count() + 2) + 1 + 1;  // mark, one picture
  EXPECT_EQ(line.substr(0, line.find(' ')), std::to_string(messages)) << line;
  EXPECT_NE(line.find("/base/mark,/base/picture,/car/brakes"), std::string::npos) << line;
}

TEST(Recorder, FiguresTellWhatBecameOfTheRecords) {
  const auto folder = transport::TemporaryFolder::create("pitwall_recorder");
  auto recorder = Recorder::start(folder->path(), {});
  ASSERT_TRUE(recorder);
  const std::string large(kQueueBytes, ' ');  // no room, even while nothing waits
  (*recorder)->text(Topic::kAudit, transport::monotonic_now(), large);
  (*recorder)->text(Topic::kMark, transport::monotonic_now(), "{}");
  const RecorderFigures figures = (*recorder)->figures();
  EXPECT_EQ(figures.dropped, 1U);
  EXPECT_EQ(figures.lost(), 1U);
  EXPECT_GT(figures.free_bytes, 0U);
  const std::string text = json_of(figures, Instant{seconds(2).ns});
  EXPECT_NE(text.find(R"("time_ms": 2000)"), std::string::npos) << text;
}

// A second of a flood: as much as the budget has is kept, and the state that comes after it.
TEST(Recorder, AFloodOfDatagramsLeavesRoomForTheRest) {
  const auto folder = transport::TemporaryFolder::create("pitwall_recorder");
  const Instant now = transport::monotonic_now();
  const std::vector<std::uint8_t> large(1'000, 7);
  constexpr std::uint64_t kFlood = 10'000;
  RecorderFigures figures;
  {
    auto recorder = Recorder::start(folder->path(), {});
    ASSERT_TRUE(recorder);
    for (std::int64_t i = 0; i < std::int64_t{kFlood}; ++i) {
      (*recorder)->datagram(true, now + microseconds(100) * i, {.bytes = large});
    }
    (*recorder)->state(sampled_at(now), all_groups(), now + seconds(1));
    figures = (*recorder)->figures();
  }
  EXPECT_EQ(figures.dropped, 0U) << "the queue had room";
  EXPECT_NEAR(static_cast<double>(kFlood - figures.left_out), 3e6 / 1'008.0, 2.0);
  EXPECT_EQ(figures.lost(), figures.left_out);
  std::uint64_t datagrams = 0, states = 0;
  for (const auto paths = segments_of(folder->path()); const auto& path : *paths) {
    const auto file = transport::read_file(path);
    recording::McapReader reader{as_bytes(*file)};
    while (const auto message = reader.next()) {
      datagrams += message->channel == kDownChannel ? 1U : 0U;
      states += message->channel == channel_of(telemetry::Group::kEgo) ? 1U : 0U;
    }
  }
  EXPECT_EQ(datagrams, kFlood - figures.left_out);
  EXPECT_EQ(states, 1U);
}

TEST(Recorder, AFolderThatCannotBeIsRefused) {
  EXPECT_FALSE(Recorder::start("/proc/nothing/here", {}));
}

// A process that records until it is killed. What it gave last is seen by its parent.
[[noreturn]] void record_until_killed(const std::string& folder, std::atomic<std::int64_t>& last) {
  auto recorder = Recorder::start(folder, {});
  for (Instant at = transport::monotonic_now(); recorder; at += milliseconds(20)) {
    transport::sleep_until(at);
    const Instant now = transport::monotonic_now();
    (*recorder)->state(sampled_at(now), all_groups(), now);
    last = now.ns;
  }
  ::_exit(1);
}

struct Killed {
  std::int64_t lost_ns = 0;
  std::uint64_t messages = 0;
};

Killed killed_after(Duration run, const std::string& folder) {
  void* const shared = ::mmap(nullptr, sizeof(std::atomic<std::int64_t>), PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto& last = *new (shared) std::atomic<std::int64_t>{0};
  const pid_t child = ::fork();
  if (child == 0) record_until_killed(folder, last);
  const Instant end = transport::monotonic_now() + run;
  while (last == 0 && transport::monotonic_now() < end + seconds(20)) {
    transport::sleep_until(transport::monotonic_now() + milliseconds(1));
  }
  transport::sleep_until(std::max(end, transport::monotonic_now() + run));
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);

  recover_folder(folder);
  Killed killed;
  std::int64_t newest = 0;
  const auto paths = segments_of(folder);
  for (const std::string& path : *paths) {
    const auto file = transport::read_file(path);
    recording::McapReader reader{as_bytes(*file)};
    while (const auto message = reader.next()) {
      const Instant at =
          clock_of(reader.run())->to_base(Instant{static_cast<std::int64_t>(message->logged_ns)});
      newest = std::max(newest, at.ns);
      ++killed.messages;
    }
    EXPECT_EQ(reader.end(), recording::McapEnd::kComplete) << path;
  }
  killed.lost_ns = last - newest;
  ::munmap(shared, sizeof(std::atomic<std::int64_t>));
  return killed;
}

TEST(Recorder, KilledAtAnyMomentItHasLostLessThanASecond) {
  std::mt19937 random{20261122};
  for (int i = 0; i < 4; ++i) {
    const auto folder = transport::TemporaryFolder::create("pitwall_killed");
    const Duration run = milliseconds(700 + static_cast<std::int64_t>(random() % 1'000));
    const Killed killed = killed_after(run, folder->path());
    EXPECT_LT(killed.lost_ns, seconds(1).ns) << run.milliseconds() << " ms";
    EXPECT_GT(killed.messages, 0U) << run.milliseconds() << " ms";
  }
}

}  // namespace
}  // namespace pitwall::recorder
