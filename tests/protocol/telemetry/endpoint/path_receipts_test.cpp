// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/path_receipts.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/support/instants.hpp"

namespace pitwall::telemetry {
namespace {

std::vector<PathLane> two_lanes() { return {PathLane{BudgetParams{}}, PathLane{BudgetParams{}}}; }

// What one end writes of its lanes, read back as records.
std::vector<std::vector<std::uint8_t>> written(std::vector<PathLane>& lanes, Instant now) {
  std::array<std::uint8_t, kMaxBody> buffer{};
  BodyWriter body(buffer, buffer.size(), Direction::kUp);
  body.begin(now, 1);
  PathReceipts::write(body, lanes, now);
  const auto parsed = parse_body(body.bytes(), Direction::kUp);
  EXPECT_TRUE(parsed);
  std::vector<std::vector<std::uint8_t>> payloads;
  for (const Record& record : parsed->records) {
    EXPECT_EQ(record.type, RecordType::kPathReceipt);
    payloads.emplace_back(record.payload.begin(), record.payload.end());
  }
  return payloads;
}

TEST(PathReceipts, EachArrivalIsToldOnce) {
  std::vector<PathLane> lanes = two_lanes();
  EXPECT_TRUE(written(lanes, at_ms(100)).empty());
  lanes[1].newest = 7;
  lanes[1].received_at = at_ms(95);
  EXPECT_EQ(written(lanes, at_ms(100)).size(), 1U);
  EXPECT_TRUE(written(lanes, at_ms(120)).empty());
  lanes[0].newest = 9;
  lanes[1].newest = 8;
  lanes[0].received_at = lanes[1].received_at = at_ms(130);
  EXPECT_EQ(written(lanes, at_ms(140)).size(), 2U);
}

// The peer sends on both paths; the second one's queue grows. Only its rate is taken back.
TEST(PathReceipts, RateControlIsOfThePathThatIsCongested) {
  PathReceipts receipts;
  std::vector<PathLane> sender = two_lanes(), receiver = two_lanes();
  const Duration ahead = seconds(500);  // of the receiver's clock
  for (std::uint64_t i = 1; i <= 300; ++i) {
    const Instant sent = at_ms(20 * static_cast<std::int64_t>(i));
    receipts.sent((std::uint64_t{1} << 32) - 100 + i, 0b11, 600, sent);
    for (std::size_t path = 0; path < 2; ++path) {
      const auto queue = milliseconds(path == 1 ? 5 * static_cast<std::int64_t>(i) : 0);
      receiver[path].newest = (std::uint64_t{1} << 32) - 100 + i;
      receiver[path].received_at = sent + milliseconds(15) + queue + ahead;
    }
    // Its packet leaves once both have come.
    const Instant answers = receiver[1].received_at + milliseconds(3);
    for (const auto& payload : written(receiver, answers)) {
      EXPECT_TRUE(receipts.take(payload, sender, answers, sent + seconds(2)));
    }
  }
  EXPECT_EQ(sender[0].rate.backoffs(), 0U);
  EXPECT_GT(sender[1].rate.backoffs(), 0U);
}

TEST(PathReceipts, WhatWasNotSentThereIsIgnored) {
  PathReceipts receipts;
  std::vector<PathLane> sender = two_lanes(), receiver = two_lanes();
  receipts.sent(5, 0b01, 600, at_ms(0));
  receiver[1].newest = 5;  // by a path that it was not sent on
  receiver[1].received_at = at_ms(10);
  for (const auto& payload : written(receiver, at_ms(12))) {
    EXPECT_FALSE(receipts.take(payload, sender, at_ms(12), at_ms(30)));
  }
  receiver[0].newest = 6;  // never sent
  receiver[0].received_at = at_ms(10);
  for (const auto& payload : written(receiver, at_ms(12))) {
    EXPECT_FALSE(receipts.take(payload, sender, at_ms(12), at_ms(30)));
  }
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::uint8_t> payload(random() % 8);
    for (std::uint8_t& byte : payload) byte = static_cast<std::uint8_t>(random());
    if (receipts.take(payload, sender, at_ms(12), at_ms(30))) {
      EXPECT_EQ(payload.size(), PathReceipts::kSize);
      EXPECT_EQ(payload[0], 0);
      EXPECT_EQ(payload[1] | payload[2] << 8, 5);
    }
  }
  receipts.forget();
  const std::array<std::uint8_t, 5> five{0, 5, 0, 0, 0};
  EXPECT_FALSE(receipts.take(five, sender, at_ms(12), at_ms(30)));
}

}  // namespace
}  // namespace pitwall::telemetry
