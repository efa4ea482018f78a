// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/command_record.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace pitwall::telemetry {
namespace {

TEST(CommandRecord, ReadsBackWhatItWroteAndTakesNothingForYounger) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const auto type = static_cast<std::uint8_t>(random() % kCommandTypes);
    const CommandRecord sent{
        .number = static_cast<CommandId>(1 + random() % 0xFFFF'FFFE),
        .base_run = static_cast<std::uint32_t>(random()),
        .car_boot = static_cast<std::uint32_t>(random()),
        .type = type,
        .step = static_cast<std::uint16_t>(random() % kCommandTable[type].quantized().count()),
        .age = nanoseconds(static_cast<std::int64_t>(random() % 60'000'000'000)),
        .issuer = static_cast<HolderId>(random())};
    const auto received = parse_command(to_bytes(sent));
    ASSERT_TRUE(received);
    EXPECT_EQ(received->number, sent.number);
    EXPECT_EQ(received->base_run, sent.base_run);
    EXPECT_EQ(received->car_boot, sent.car_boot);
    EXPECT_EQ(received->type, sent.type);
    EXPECT_EQ(received->step, sent.step);
    EXPECT_EQ(received->issuer, sent.issuer);
    EXPECT_GE(received->age, sent.age);
    EXPECT_LE(received->age, sent.age + microseconds(1'100));
  }
}

TEST(CommandRecord, AnAgeBeyondItsFieldStaysBeyondEveryTimeToLive) {
  CommandRecord sent{.number = 1};
  sent.age = seconds(100'000'000);
  const Duration received = parse_command(to_bytes(sent))->age;
  for (const CommandRow& row : kCommandTable) EXPECT_GT(received, row.time_to_live);
}

// Every length that is not right, and in the right length everything that nobody writes.
TEST(CommandRecord, RefusesWhatItsWriterDoesNotMake) {
  std::vector<std::uint8_t> bytes(64, 1);
  bytes[13] = bytes[14] = 0;  // a step that every row has
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto payload = std::span<const std::uint8_t>{bytes}.first(size);
    EXPECT_EQ(parse_command(payload).has_value(), size == kCommandSize) << size;
    EXPECT_EQ(parse_result(payload).has_value(), size == kResultSize) << size;
    EXPECT_EQ(parse_result_ack(payload).has_value(), size == kResultAckSize) << size;
  }
  EXPECT_FALSE(parse_command(to_bytes(CommandRecord{.number = 0})));
  CommandRecord beyond{.number = 1};
  for (std::size_t type = 0; type < kCommandTypes; ++type) {
    beyond.type = static_cast<std::uint8_t>(type);
    const auto count = kCommandTable[type].quantized().count();
    for (std::uint64_t step = count; step < 65'536; step = step * 2 + 1) {
      beyond.step = static_cast<std::uint16_t>(step);
      EXPECT_FALSE(parse_command(to_bytes(beyond))) << type << ' ' << step;
    }
  }
  auto ageless = to_bytes(CommandRecord{.number = 1});
  ageless[15] = ageless[16] = 0;
  EXPECT_FALSE(parse_command(ageless));
  EXPECT_FALSE(parse_result(to_bytes(ResultRecord{.number = 0})));
  auto unknown = to_bytes(ResultRecord{.number = 1});
  unknown[8] = kOutcomes;
  EXPECT_FALSE(parse_result(unknown));
  EXPECT_FALSE(parse_result_ack(to_bytes(ResultAckRecord{.number = 0})));
}

TEST(CommandRecord, ACommandOfALaterBuildIsReadSoThatItCanBeAnswered) {
  for (int type = kCommandTypes; type < 256; ++type) {
    const auto received = parse_command(to_bytes(
        CommandRecord{.number = 1, .type = static_cast<std::uint8_t>(type), .step = 65'535}));
    ASSERT_TRUE(received);
    EXPECT_FALSE(received->known());
  }
}

}  // namespace
}  // namespace pitwall::telemetry
