// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/schema_exchange.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "protocol/telemetry/registry/schema.hpp"

namespace pitwall::telemetry {
namespace {

constexpr std::uint64_t kOther = kSchemaHash ^ 1;

std::vector<std::vector<std::uint8_t>> records_of(SchemaExchange& talk, int packets) {
  std::vector<std::vector<std::uint8_t>> records;
  for (int i = 0; i < packets; ++i) {
    std::array<std::uint8_t, kMaxBody> buffer{};
    BodyWriter body(buffer, kMaxBody, Direction::kDown);
    body.begin({}, 1);
    const std::size_t size = talk.size();
    talk.write(body);
    EXPECT_EQ(body.bytes().size(), kBodyFixed + size);
    const auto parsed = parse_body(body.bytes(), Direction::kDown);
    EXPECT_TRUE(parsed.has_value());
    for (const Record& record : parsed->records) {
      EXPECT_EQ(record.type, RecordType::kSchema);
      records.emplace_back(record.payload.begin(), record.payload.end());
    }
  }
  return records;
}

TEST(SchemaExchange, TheSameRegistryIsNotTalkedAbout) {
  SchemaExchange car(own_schema(), Direction::kDown);
  car.begin(kSchemaHash);
  EXPECT_TRUE(car.may_send());
  EXPECT_EQ(car.size(), 0u);
  EXPECT_TRUE(records_of(car, 3).empty());
  EXPECT_EQ(car.reading().size(), groups_of(Direction::kUp).count());
}

TEST(SchemaExchange, NothingIsReadBeforeAllIsKnownWhateverTheOrder) {
  SchemaExchange car(own_schema(), Direction::kDown), base(own_schema(), Direction::kUp);
  car.begin(kOther);
  base.begin(kOther);
  EXPECT_FALSE(car.may_send());
  auto records = records_of(car, 3);
  ASSERT_EQ(records.size(), 3u);
  for (const std::size_t which : {2U, 0U}) {
    EXPECT_TRUE(base.take(records[which]));
    EXPECT_TRUE(base.take(records[which]));  // twice is once
    EXPECT_TRUE(base.reading().empty());
  }
  EXPECT_TRUE(base.take(records[1]));
  ASSERT_EQ(base.reading().size(), groups_of(Direction::kDown).count());
  for (const GroupPlace& place : base.reading()) EXPECT_TRUE(place.own);
  // The base says so, and the car may send.
  for (const auto& record : records_of(base, 1)) EXPECT_TRUE(car.take(record));
  EXPECT_TRUE(car.may_send());
  EXPECT_FALSE(base.may_send());
}

TEST(SchemaExchange, AGroupOfAnotherHashIsSkippedByItsSize) {
  SchemaDescription other = own_schema();
  other.down[3].hash ^= 1;
  SchemaExchange car(other, Direction::kDown), base(own_schema(), Direction::kUp);
  car.begin(kSchemaHash ^ 5);
  base.begin(kOther);
  for (const auto& record : records_of(car, 3)) EXPECT_TRUE(base.take(record));
  for (std::size_t k = 0; k < base.reading().size(); ++k) {
    EXPECT_EQ(base.reading()[k].own.has_value(), k != 3);
    EXPECT_EQ(base.reading()[k].bits, own_schema().down[k].group.bits);
  }
}

TEST(SchemaExchange, WhatIsNoListIsRefused) {
  SchemaExchange car(own_schema(), Direction::kDown), base(own_schema(), Direction::kUp);
  car.begin(kOther);
  base.begin(kOther);
  const auto good = records_of(car, 1).front();
  for (std::size_t size = 0; size < good.size(); ++size) {
    const bool whole = size >= 3 && (size - 3) % 6 == 0;
    SchemaExchange fresh(own_schema(), Direction::kUp);
    fresh.begin(kOther);
    EXPECT_EQ(fresh.take(std::span(good).first(size)), whole) << size;
  }
  for (const auto& [at, value] :
       {std::pair<std::size_t, std::uint8_t>{0, 2}, {1, 0}, {1, 65}, {2, 32}, {2, 255}}) {
    auto bad = good;
    bad[at] = value;
    EXPECT_FALSE(base.take(bad)) << at << " " << int{value};
  }
  SchemaExchange same(own_schema(), Direction::kUp);
  same.begin(kSchemaHash);
  EXPECT_FALSE(same.take(good));
}

}  // namespace
}  // namespace pitwall::telemetry
