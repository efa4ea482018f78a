// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/fault_coverage/fault_matrix.hpp"

#include <gtest/gtest.h>

#include <string>

#include "hil/cli/fault_coverage/catalogue.hpp"

namespace pitwall::fault_coverage {
namespace {

FaultRow good(const std::string& scenario) {
  return {.id = id_of(scenario),
          .scenario = scenario,
          .detections = {{.by = "counter",
                          .delay = milliseconds(10),
                          .deadline = milliseconds(20),
                          .passed = true,
                          .reason = {}}},
          .outcome = "at the end the car stands",
          .failed = {},
          .simulated_s = 30.0};
}

std::vector<FaultRow> whole() {
  std::vector<FaultRow> rows;
  for (const CatalogueRow& row : kCatalogue) rows.push_back(good(std::string(row.id) + "_x"));
  return rows;
}

TEST(FaultMatrix, TheIdIsTheBeginningOfTheName) {
  EXPECT_EQ(id_of("f01_frames_lost"), "F01");
  EXPECT_EQ(id_of("f36_killed"), "F36");
  EXPECT_EQ(id_of("x_oversteer"), "-") << "beside the catalogue";
}

TEST(FaultMatrix, ARowNeedsADetectionInTimeAndAGoodEnd) {
  FaultRow row = good("f01_x");
  EXPECT_TRUE(row.passed());
  row.detections[0].passed = false;
  EXPECT_FALSE(row.passed());
  row = good("f01_x");
  row.detections.clear();
  EXPECT_FALSE(row.passed());
  row = good("f01_x");
  row.failed.emplace_back("a wall");
  EXPECT_FALSE(row.passed());
}

TEST(FaultMatrix, AFaultThatIsNotNoticedIsAHole) {
  std::vector<FaultRow> rows = whole();
  EXPECT_TRUE(holes(rows).empty());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<FaultRow> one_bad = rows;
    one_bad[i].detections[0].passed = false;
    ASSERT_EQ(holes(one_bad).size(), 1u);
    EXPECT_EQ(holes(one_bad)[0], kCatalogue[i].id);
    std::vector<FaultRow> one_gone = rows;
    one_gone.erase(one_gone.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_EQ(holes(one_gone).size(), 1u);
  }
}

TEST(FaultMatrix, TheTableNamesWhatFails) {
  std::vector<FaultRow> rows{good("f06_frames_twice")};
  EXPECT_NE(to_text(rows).find("counter"), std::string::npos);
  EXPECT_NE(to_text(rows).find("1 of 1 scenarios passed"), std::string::npos);
  EXPECT_NE(to_text(rows).find("not covered: F01"), std::string::npos);
  rows[0].failed.emplace_back("a wall");
  EXPECT_NE(to_text(rows).find("FAILED: a wall"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::fault_coverage
