// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/difference_text.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pitwall::cli {
namespace {

const bench::SignalDifference kDifference{
    .signal = "ego.vx",
    .values = 3,
    .first = {.tick = 7, .at = Instant{seconds(12).ns}, .recorded = 1.0, .again = 1.5},
    .largest = {.tick = 9, .at = Instant{seconds(14).ns}, .recorded = 2.0, .again = -1.0},
    .context = "mode driving"};

TEST(DifferenceText, NamesSignalCountFirstAndLargest) {
  const std::string text = differences_text(std::vector{kDifference}, Instant{seconds(10).ns});
  EXPECT_EQ(text,
            "ego.vx: 3 values differ\n"
            "  first         2.00 s, tick 7: recorded 1, now 1.5; mode driving\n"
            "  largest       4.00 s: recorded 2, now -1, by 3\n");
  EXPECT_EQ(differences_text({}, Instant{}), "");
}

TEST(DifferenceText, JsonHoldsTheSame) {
  const std::string text = differences_json(std::vector{kDifference}, Instant{seconds(10).ns});
  for (const char* part : {R"("signal": "ego.vx")", R"("values": 3)", R"("tick": 7)",
                           R"("at_s": 2)", R"("now": -1)", R"("context": "mode driving")"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  EXPECT_EQ(differences_json({}, Instant{}), "[]");
}

}  // namespace
}  // namespace pitwall::cli
