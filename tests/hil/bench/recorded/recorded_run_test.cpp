// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/recorded_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "protocol/recorder/segment_folder.hpp"
#include "protocol/recording/mcap_writer.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "tests/hil/bench/recorded/recorded_drive.hpp"

namespace pitwall::bench {
namespace {

std::string refusal_of(const std::string& path) {
  auto run = RecordedRun::open(path);
  if (!run) return to_string(run.error());
  while (true) {
    const auto tick = run->next();
    if (!tick) return to_string(tick.error());
    if (!*tick) return {};
  }
}

std::uint64_t ticks_of(RecordedRun& run) {
  for (std::uint64_t ticks = 0;; ++ticks) {
    const auto tick = run.next();
    EXPECT_TRUE(tick) << to_string(tick.error());
    if (!tick || !*tick) return ticks;
  }
}

std::string segment() { return recorder::segments_of(recorded_folder())->front(); }

// The recording again, but for the n-th message of a topic.
std::string without(const std::string& folder, const std::string& topic, std::uint64_t n) {
  const std::string bytes = *transport::read_file(segment()), path = folder + "/without.mcap";
  recording::McapReader reader{as_bytes(bytes)};
  const std::vector<recording::Channel> channels = recorder::channels();
  std::ofstream out{path, std::ios::binary};
  std::optional<recording::McapWriter> writer;
  std::uint64_t seen = 0;
  while (const auto message = reader.next()) {
    if (!writer)
      writer.emplace(channels, reader.run(), [&](std::span<const std::uint8_t> some) {
        out.write(reinterpret_cast<const char*>(some.data()),
                  static_cast<std::streamsize>(some.size()));
        return true;
      });
    const std::string& here = reader.channels().at(message->channel).topic;
    if (here == topic && seen++ == n) continue;
    const auto place = std::ranges::find(channels, here, &recording::Channel::topic);
    const Instant at{static_cast<std::int64_t>(message->logged_ns)};
    EXPECT_TRUE(writer->write({static_cast<std::uint16_t>(place - channels.begin())}, at,
                              Instant{static_cast<std::int64_t>(message->published_ns)},
                              message->data));
  }
  EXPECT_TRUE(writer->close());
  return path;
}

TEST(RecordedRun, HasEveryTickWithAllThatItWasGiven) {
  auto run = RecordedRun::open(recorded_folder());
  ASSERT_TRUE(run) << to_string(run.error());
  std::uint64_t ticks = 0, states = 0, bytes = 0;
  std::size_t done = 0;
  while (true) {
    const auto tick = run->next();
    ASSERT_TRUE(tick) << to_string(tick.error());
    if (!*tick) break;
    EXPECT_GE(run->done(), std::exchange(done, run->done()));
    EXPECT_EQ((*tick)->given.number, ticks);
    EXPECT_EQ((*tick)->now, pipeline::testing::kStart + kTick * static_cast<std::int64_t>(ticks));
    EXPECT_FALSE((*tick)->received.empty());
    for (const ReceiverBytes& some : (*tick)->receivers) bytes += some.bytes.size();
    states += (*tick)->state ? 1U : 0U;
    ++ticks;
  }
  EXPECT_EQ(ticks, kDrivenTicks);
  EXPECT_EQ(states, kDrivenTicks / 2);
  EXPECT_GT(bytes, 10'000U);
  EXPECT_EQ(run->size(), transport::read_file(segment())->size());
  EXPECT_GT(done, run->size() / 2) << "an index is behind the last tick";
  EXPECT_LT(done, run->size());
  EXPECT_EQ(run->begun(), pipeline::testing::kStart);
  EXPECT_TRUE(run->remarks().empty());
  EXPECT_EQ(run->metadata("base"), "watched");
}

TEST(RecordedRun, GoesToTheEndOfOneThatWasCutOffAndSaysWhere) {
  const auto folder = *transport::TemporaryFolder::create("pitwall-cut-");
  const std::string whole = *transport::read_file(segment()), path = folder.path() + "/cut.mcap";
  std::ofstream{path, std::ios::binary} << whole.substr(0, whole.size() / 2);
  auto run = RecordedRun::open(path);
  ASSERT_TRUE(run) << to_string(run.error());
  const std::uint64_t ticks = ticks_of(*run);
  EXPECT_GT(ticks, 10U);
  EXPECT_LT(ticks, kDrivenTicks);
  ASSERT_EQ(run->remarks().size(), 1U);
  EXPECT_EQ(run->remarks()[0].rfind(path + ": byte ", 0), 0U) << run->remarks()[0];
}

TEST(RecordedRun, NamesTheTickOfWhichSomethingIsMissing) {
  const auto folder = *transport::TemporaryFolder::create("pitwall-missing-");
  const auto lacking = [&](const char* topic, std::uint64_t n) {
    const std::string path = without(folder.path(), topic, n), text = refusal_of(path);
    EXPECT_EQ(text.rfind(path + ": error: ", 0), 0U) << text;
    return text.substr(std::min(text.size(), path.size() + 9));
  };
  EXPECT_EQ(lacking("/car/tick", 100), "tick 100 is not recorded, the next is 101");
  EXPECT_EQ(lacking("/car/tick", 0), "tick 0 is not recorded, the next is 1");
  EXPECT_NE(lacking("/gnss/0", 1).find("bytes of receivers are recorded"), std::string::npos);
  EXPECT_NE(lacking("/can/in", 5).find("received frames are recorded"), std::string::npos);
  EXPECT_NE(lacking("/can/out", 5).find("sent frames are recorded"), std::string::npos);
}

TEST(RecordedRun, EndsWhereACarThatWasStartedAgainBeginsAnotherRun) {
  const auto folder = *transport::TemporaryFolder::create("pitwall-twice-");
  const std::string name = segment().substr(segment().rfind('/') + 1);
  const std::string first = folder.path() + "/" + name;
  const std::string second = folder.path() + "/pitwall_99991231T235959.000Z_00000.mcap";
  for (const std::string& file : {first, second})
    std::ofstream{file, std::ios::binary} << *transport::read_file(segment());
  auto run = RecordedRun::open(folder.path());
  ASSERT_TRUE(run) << to_string(run.error());
  const std::uint64_t ticks = ticks_of(*run);
  EXPECT_EQ(ticks, kDrivenTicks);
  EXPECT_EQ(run->remarks(),
            (std::vector<std::string>{second + ": another run begins here, compare it alone"}));
}

TEST(RecordedRun, RefusesWhatIsNoCarsRecording) {
  const auto folder = *transport::TemporaryFolder::create("pitwall-no-run-");
  EXPECT_EQ(refusal_of(folder.path()), folder.path() + ": error: no recording is in this folder");
  const std::string text = folder.path() + "/text.mcap";
  std::ofstream{text} << "no recording";
  EXPECT_EQ(refusal_of(text).rfind(text + ": error: ", 0), 0U) << refusal_of(text);
  EXPECT_EQ(refusal_of("/nowhere").rfind("/nowhere", 0), 0U);
}

}  // namespace
}  // namespace pitwall::bench
