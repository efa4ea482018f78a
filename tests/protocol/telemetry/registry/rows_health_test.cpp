// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/rows_health.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::telemetry {
namespace {

TEST(ReceiverRows, AreTheSameForBothUnits) {
  const auto first = fields_of(Group::kGnss0), second = fields_of(Group::kGnss1);
  ASSERT_EQ(first.count, second.count);
  EXPECT_EQ(group_bits(Group::kGnss0), group_bits(Group::kGnss1));
  for (std::size_t i = 0; i < first.count; ++i)
    EXPECT_EQ(kFields[first.first + i].name, kFields[second.first + i].name);
}

// The car writes rate, gap, latency and, where they are counted, drops one after the other; of a
// camera that is watched what it sees off too.
TEST(SensorRows, OfOneSensorStandTogether) {
  const auto [first, count] = fields_of(Group::kSensors);
  for (std::size_t i = first; i < first + count;) {
    const std::string_view name = kFields[i].name;
    ASSERT_TRUE(name.ends_with("_rate")) << name;
    const std::string sensor{name.substr(0, name.find('_') + 1)};
    ASSERT_LE(i + 3, first + count) << name;
    EXPECT_EQ(kFields[i + 1].name, sensor + "gap");
    EXPECT_EQ(kFields[i + 2].name, sensor + "latency");
    i += 3;
    if (i < first + count && kFields[i].name == sensor + "drops") ++i;
    if (i < first + count && kFields[i].name == sensor + "bearing_bias") {
      EXPECT_EQ(kFields[i + 1].name, sensor + "distance_ratio");
      i += 2;
    }
  }
}

// One bit for every cause but the first, "none".
TEST(FaultRows, HaveABitForEachCauseOfAStop) {
  std::size_t causes = 0;
  while (!label_at(kStopCauses, causes).empty()) ++causes;
  ASSERT_GT(causes - 1, kFaultBits);
  const auto largest = [](std::size_t bits) { return static_cast<double>((1ULL << bits) - 1); };
  EXPECT_GE(kFields[field("faults.now")].max + 1.0, largest(kFaultBits));
  EXPECT_GE(kFields[field("faults.now_more")].max, largest(causes - 1 - kFaultBits));
  for (std::size_t i = 1; i < causes; ++i) {
    const bool first = i <= kFaultBits;
    EXPECT_EQ(label_at(first ? kFaultNames : kFaultNamesMore, first ? i - 1 : i - 1 - kFaultBits),
              label_at(kStopCauses, i));
  }
  EXPECT_TRUE(label_at(kFaultNames, kFaultBits).empty());
}

}  // namespace
}  // namespace pitwall::telemetry
