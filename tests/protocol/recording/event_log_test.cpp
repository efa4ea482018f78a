// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/event_log.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/recording/mcap_reader.hpp"
#include "tests/protocol/recording/mcap_samples.hpp"

namespace pitwall::recording {
namespace {

struct Recorded {
  testing::MemoryFile file;
  std::string digest;
};

Recorded record(std::uint32_t seed) {
  Recorded run;
  EventLog log{{{"seed", std::to_string(seed)}}, run.file.sink()};
  const auto samples = log.channel<testing::Sample>("/samples");
  log.start();
  for (std::uint32_t i = 0; i < 30; ++i) {
    EXPECT_TRUE(log.sample(samples, Instant{i * 10}, testing::sample(i)));
    if (i % 10 == 0) {
      EXPECT_TRUE(log.event(Instant{i * 10}, "flag", "green"));
    }
  }
  EXPECT_TRUE(log.flush());
  EXPECT_TRUE(log.close());
  EXPECT_EQ(log.counters().messages, 33U);
  run.digest = bits::to_hex(log.digest());
  return run;
}

TEST(EventLog, SamplesAndEventsComeBack) {
  const Recorded run = record(1);
  McapReader reader{run.file.bytes};
  std::uint32_t samples = 0;
  std::string events;
  while (const auto m = reader.next()) {
    const Channel& channel = reader.channels().at(m->channel);
    if (channel.topic == kEventTopic) {
      events.append(m->data.begin(), m->data.end()).append("\n");
      continue;
    }
    testing::Sample back;
    ASSERT_TRUE(from_cdr(m->data, back));
    EXPECT_EQ(back.speed_mps, testing::sample(samples).speed_mps);
    EXPECT_EQ(m->logged_ns, samples * 10);
    ++samples;
  }
  EXPECT_EQ(reader.end(), McapEnd::kComplete);
  EXPECT_EQ(samples, 30U);
  const std::string green = R"({"name":"flag","text":"green"})"
                            "\n";
  EXPECT_EQ(events, green + green + green);
}

TEST(EventLog, TheDigestIsThatOfTheFileAndNamesTheRun) {
  const Recorded run = record(1);
  bits::Sha256 hash;
  hash.update(run.file.bytes);
  EXPECT_EQ(run.digest, bits::to_hex(hash.digest()));
  EXPECT_EQ(run.digest, record(1).digest);
  EXPECT_NE(run.digest, record(2).digest);
}

TEST(EventLog, AnEventIsAlwaysValidJsonOfBoundedLength) {
  testing::MemoryFile file;
  EventLog log{{}, file.sink()};
  log.start();
  EXPECT_TRUE(log.event(Instant{}, "a\"b\\c", "line\nbreak \xFF \x01 end"));
  EXPECT_TRUE(log.event(Instant{}, std::string(999, 'n'), std::string(99'999, '"')));
  EXPECT_TRUE(log.close());
  McapReader reader{file.bytes};
  const auto first = reader.next();
  ASSERT_TRUE(first);
  EXPECT_EQ((std::string{first->data.begin(), first->data.end()}),
            R"({"name":"a\"b\\c","text":"line?break ? ? end"})");
  const auto second = reader.next();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->data.size(), 9 + kEventNameMax + 10 + 2 * kEventTextMax + 2);
}

TEST(EventLog, ADeadSinkIsCountedAndNotHashed) {
  EventLog log{{}, [](std::span<const std::uint8_t>) { return false; }};
  log.start();
  EXPECT_FALSE(log.event(Instant{}, "flag", "red"));
  EXPECT_FALSE(log.close());
  EXPECT_EQ(log.counters().refused_sink, 1U);
  EXPECT_EQ(bits::to_hex(log.digest()), bits::to_hex(bits::Sha256{}.digest()));
}

}  // namespace
}  // namespace pitwall::recording
