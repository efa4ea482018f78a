// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/export/handbook.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::telemetry {
namespace {

TEST(Handbook, HasASectionForEachGroupAndARowForEachField) {
  std::istringstream page{handbook_markdown()};
  std::size_t sections = 0, rows = 0;
  for (std::string line; std::getline(page, line);) {
    sections += line.starts_with("## ") ? 1U : 0U;
    const bool head = line.starts_with("| field |") || line.starts_with("| command |");
    rows += line.starts_with("| ") && !head ? 1U : 0U;
  }
  EXPECT_EQ(sections, kGroups + 1);
  EXPECT_GT(rows, kFieldCount);
}

// A cell that held the separator would shift all that follow it.
TEST(Handbook, EveryRowOfATableHasAsManyCellsAsItsHead) {
  std::istringstream page{handbook_markdown()};
  std::ptrdiff_t bars = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("|")) {
      bars = 0;
      continue;
    }
    const auto here = std::count(line.begin(), line.end(), '|');
    if (bars == 0) bars = here;
    EXPECT_EQ(here, bars) << line;
  }
}

}  // namespace
}  // namespace pitwall::telemetry
