// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/labels.hpp"

#include <gtest/gtest.h>

namespace pitwall::telemetry {
namespace {

TEST(Labels, AreCountedFromZeroAndEmptyPastTheEnd) {
  EXPECT_EQ(label_at("a|bc|d", 0), "a");
  EXPECT_EQ(label_at("a|bc|d", 1), "bc");
  EXPECT_EQ(label_at("a|bc|d", 2), "d");
  EXPECT_EQ(label_at("a|bc|d", 3), "");
  EXPECT_EQ(label_at("", 0), "");
}

}  // namespace
}  // namespace pitwall::telemetry
