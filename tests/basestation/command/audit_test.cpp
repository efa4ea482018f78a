// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/audit.hpp"

#include <gtest/gtest.h>

namespace pitwall::command {
namespace {

TEST(Audit, NumbersEveryLineAndKeepsTheNewest) {
  Audit audit;
  for (std::size_t i = 0; i < Audit::kKept + 10; ++i) {
    audit.add(Instant{static_cast<std::int64_t>(i)}, "Ada", "act", "done");
  }
  EXPECT_EQ(audit.count(), Audit::kKept + 10);
  ASSERT_EQ(audit.lines().size(), Audit::kKept);
  EXPECT_EQ(audit.lines().front().number, 11U);
  EXPECT_EQ(audit.lines().back(),
            (AuditLine{Audit::kKept + 10, Instant{Audit::kKept + 9}, "Ada", "act", "done"}));
}

}  // namespace
}  // namespace pitwall::command
