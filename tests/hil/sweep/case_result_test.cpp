// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/case_result.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace pitwall::sweep {
namespace {

CaseResult some_result() {
  return {.number = 37,
          .verdict = CaseVerdict::kFailed,
          .why = "",
          .digest = "ab12",
          .simulated_s = 100.0,
          .wall_s = 1.25,
          .margins = {{"always \"x\" < 1", -0.1, false}, {"never y", 3.0, true}}};
}

TEST(CaseResult, IsReadAsItWasWritten) {
  for (std::size_t k = 0; k < kCaseVerdicts; ++k) {
    CaseResult result = some_result();
    result.verdict = static_cast<CaseVerdict>(k);
    result.why = "why\nnot";
    const std::string line = to_line(result);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const auto read = parse_case_result(line);
    ASSERT_TRUE(read) << line;
    EXPECT_EQ(to_line(*read), line);
    EXPECT_EQ(read->verdict, result.verdict);
    EXPECT_EQ(read->margins[0].margin, -0.1);
    EXPECT_EQ(read->margins[1].text, "never y");
  }
}

TEST(CaseResult, AMarginThatIsNotFiniteStaysSo) {
  CaseResult result = some_result();
  result.margins[0].margin = -std::numeric_limits<double>::infinity();
  const auto read = parse_case_result(to_line(result));
  ASSERT_TRUE(read);
  EXPECT_FALSE(std::isfinite(read->margins[0].margin));
}

TEST(CaseResult, IsFoundByItsNumberAmongOthers) {
  const std::vector<CaseResult> results{{.number = 2}, {.number = 5}, {.number = 9}};
  EXPECT_EQ(&result_of(results, 5), &results[1]);
  EXPECT_DEATH(result_of(results, 4), "CHECK");
}

TEST(CaseResult, ALineThatIsCutIsNone) {
  const std::string line = to_line(some_result());
  for (std::size_t length = 0; length < line.size(); ++length)
    EXPECT_FALSE(parse_case_result(line.substr(0, length))) << length;
  EXPECT_FALSE(parse_case_result("{\"case\": 1.5, \"verdict\": \"passed\"}"));
  EXPECT_FALSE(parse_case_result("{\"case\": -1, \"verdict\": \"passed\"}"));
  EXPECT_FALSE(parse_case_result("{\"case\": 1, \"verdict\": \"good\"}"));
  EXPECT_FALSE(parse_case_result("[1]"));
}

}  // namespace
}  // namespace pitwall::sweep
