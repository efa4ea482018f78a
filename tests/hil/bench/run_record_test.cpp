// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/run_record.hpp"

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "hil/bench/lockstep/lockstep.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "tests/hil/bench/flying_lap.hpp"

namespace pitwall::bench {
namespace {

using Bytes = std::vector<std::uint8_t>;

recording::Sink into(Bytes& file) {
  return [&file](std::span<const std::uint8_t> bytes) {
    file.insert(file.end(), bytes.begin(), bytes.end());
    return true;
  };
}

std::map<std::string, std::size_t> messages_of(recording::McapReader& reader) {
  std::map<std::string, std::size_t> messages;
  while (const auto message = reader.next())
    ++messages[reader.channels().at(message->channel).topic];
  return messages;
}

std::string sha256_of(const Bytes& bytes) {
  bits::Sha256 hash;
  hash.update(bytes);
  return bits::to_hex(hash.digest());
}

TEST(RunRecord, HoldsEveryTickAndEveryFrameOfARun) {
  scenario::Scenario part = lap().scenario;
  part.duration = seconds(12);
  Bytes file;
  const auto run = run_lockstep(part, lap().setup, {.log = into(file)});
  ASSERT_TRUE(run);

  recording::McapReader reader(file);
  const auto messages = messages_of(reader);
  EXPECT_EQ(reader.end(), recording::McapEnd::kComplete);
  EXPECT_EQ(messages.at("/truth"), 1201u);
  EXPECT_EQ(messages.at("/car"), 1201u);
  const Traffic& traffic = run->traffic;
  EXPECT_NEAR(static_cast<double>(messages.at("/can")),
              static_cast<double>(traffic.to_car + traffic.from_car), 40.0)
      << "each frame once; the last ones are still on their way";
  EXPECT_GE(messages.at("/events"), 4u + part.expect.size());
}

TEST(RunRecord, SaysWhatItIsAndItsDigestIsThatOfTheFile) {
  Bytes file;
  RunRecord record(lap().scenario, "live", into(file));
  can::Frame frame;
  frame.id = 1300;
  frame.length = 8;
  record.can(Node::kDriveByWire, frame, Instant{} + milliseconds(5));
  record.event(Instant{} + milliseconds(6), "flag", "green");
  EXPECT_TRUE(record.close());
  EXPECT_EQ(record.digest(), sha256_of(file));

  recording::McapReader reader(file);
  const auto messages = messages_of(reader);
  EXPECT_EQ(reader.end(), recording::McapEnd::kComplete);
  EXPECT_EQ(messages.at("/can"), 1u);
  EXPECT_EQ(messages.at("/events"), 1u);
  std::map<std::string, std::string> run;
  for (const auto& [key, text] : reader.run()) run[key] = text;
  EXPECT_EQ(run["scenario"], "lvms_flying_lap");
  EXPECT_EQ(run["seed"], "7");
  EXPECT_EQ(run["mode"], "live");
  EXPECT_EQ(run["source"], "simulation") << "a record of the bench can never pass for a drive";
}

TEST(RunRecord, ASinkThatRefusesIsNoticed) {
  RunRecord record(lap().scenario, "lockstep", [](std::span<const std::uint8_t>) { return false; });
  EXPECT_FALSE(record.close());
}

TEST(RunRecord, ACarSampleIsWhatTheStepSaid) {
  pipeline::Outputs out;
  out.ego.x_m = 1.0;
  out.ego.vx_mps = 2.0;
  out.chosen.command.brake_kpa = 3.0;
  out.chosen.mode = world::Mode::kControlledStop;
  out.chosen.cause = safety::Cause::kImuLost;
  out.passed.refused_total = 4;
  out.received.bus.refused.stuck_counter = 5;
  const CarSample sample = car_sample(out);
  EXPECT_EQ(sample.x_m, 1.0);
  EXPECT_EQ(sample.vx_mps, 2.0);
  EXPECT_EQ(sample.brake_kpa, 3.0);
  EXPECT_EQ(sample.mode, 3);
  EXPECT_EQ(sample.cause, static_cast<std::uint8_t>(safety::Cause::kImuLost));
  EXPECT_EQ(sample.gate_refusals, 4u);
  EXPECT_EQ(sample.frames_refused, 5u);
}

}  // namespace
}  // namespace pitwall::bench
