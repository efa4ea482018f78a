// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/track_csv.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/hil/track_file/csv_text.hpp"

namespace pitwall::track_file {
namespace {

std::string rows(const std::string& row, std::size_t count) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i) {
    std::string one = row;
    for (std::size_t at = one.find('@'); at != std::string::npos; at = one.find('@'))
      one.replace(at, 1, std::to_string(i));
    out += one + "\n";
  }
  return out;
}

TEST(TrackCsv, ReadsTheRacetrackDatabase) {
  const auto csv = read_track_csv(csv_text(stadium()), "t.csv");
  ASSERT_TRUE(csv) << to_string(csv.error());
  EXPECT_EQ(csv->rows.size(), stadium().size());
  EXPECT_TRUE(csv->has_place);
  EXPECT_FALSE(csv->has_bank);
  EXPECT_EQ(csv->rows[0].line, 2u);
  EXPECT_NEAR(csv->rows[0].width_right_m, 7.0, 1e-12);
  EXPECT_NEAR(csv->rows[0].width_left_m, 8.0, 1e-12);
  EXPECT_TRUE(std::isnan(csv->rows[0].bank_rad));
}

TEST(TrackCsv, ReadsSemicolonsCommentsWindowsLinesAndColumnsItDoesNotNeed) {
  const auto csv = read_track_csv(
      "# 0e3f6f80\r\n\r\n# x_ref_m; y_ref_m; width_right_m; width_left_m; alpha_m; "
      "banking_rad\r\n" +
          rows("@; 2.5; 3.0; +4.0; 9.0; -0.1571\r", kRowsMin),
      "t.csv");
  ASSERT_TRUE(csv) << to_string(csv.error());
  EXPECT_NEAR(csv->rows[3].x_m, 3.0, 1e-12);
  EXPECT_NEAR(csv->rows[3].width_left_m, 4.0, 1e-12);
  EXPECT_NEAR(csv->rows[3].bank_rad, 0.1571, 1e-12) << "TUM's sign is turned";
  EXPECT_EQ(csv->rows[3].line, 7u);
}

TEST(TrackCsv, ReadsStationsAndCurvature) {
  const auto csv = read_track_csv("s_m,curvature_per_m,width_left_m,width_right_m,bank_deg,z_m\n" +
                                      rows("@,0.01,5,6,9,610", kRowsMin),
                                  "t.csv");
  ASSERT_TRUE(csv) << to_string(csv.error());
  EXPECT_FALSE(csv->has_place);
  EXPECT_TRUE(csv->has_bank && csv->has_height);
  EXPECT_NEAR(csv->rows[0].bank_rad, from_deg(9.0), 1e-12);
  EXPECT_NEAR(csv->rows[0].height_m, 610.0, 1e-12);
}

struct RefusedRow {
  const char *header, *row;
  std::size_t count;
  const char *place, *reason;
};

TEST(TrackCsv, RefusesWithTheLine) {
  constexpr const char* kGood = "x_m,y_m,w_tr_right_m,w_tr_left_m";
  const std::array refusals{
      RefusedRow{"", "", 0, "t.csv:1", "no header"},
      RefusedRow{"", "@,2,3,4", 30, "t.csv:2", "numbers before a header"},
      RefusedRow{"x_m,y_m,breite", "@,2,3", 30, "t.csv:1", "unknown column \"breite\""},
      RefusedRow{"x_m,y_m,x_ref_m", "@,2,3", 30, "t.csv:1", "has the same meaning as"},
      RefusedRow{"x_m,y_m,w_tr_right_m", "@,2,3", 30, "t.csv:1", "no walls"},
      RefusedRow{"x_m,w_tr_right_m,w_tr_left_m", "@,2,3", 30, "t.csv:1", "no line"},
      RefusedRow{kGood, "@,2,3,4", kRowsMin - 1, "t.csv:20", "19 points"},
      RefusedRow{kGood, "@,2,3,4", kRowsMax + 1, "t.csv:20002", "more than 20000"},
      RefusedRow{kGood, "@,2,3", 30, "t.csv:2", "3 fields, the header has 4"},
      RefusedRow{kGood, "@,2,3,4,5", 30, "t.csv:2", "5 fields, the header has 4"},
      RefusedRow{kGood, "@,nan,3,4", 30, "t.csv:2", "not a finite number"},
      RefusedRow{kGood, "@,inf,3,4", 30, "t.csv:2", "not a finite number"},
      RefusedRow{kGood, "@,1e999,3,4", 30, "t.csv:2", "not a finite number"},
      RefusedRow{kGood, "@,2 m,3,4", 30, "t.csv:2", "y_m: \"2 m\" is not a finite number"},
      RefusedRow{kGood, "@,,3,4", 30, "t.csv:2", "not a finite number"},
      RefusedRow{kGood, "@,2,0,4", 30, "t.csv:2", "a width is not positive"},
      RefusedRow{kGood, "@,2,3,-4", 30, "t.csv:2", "a width is not positive"},
      RefusedRow{kGood, "@,2,3,900", 30, "t.csv:2", "beyond 200 m"},
      RefusedRow{kGood, "1,2,3,4", 30, "t.csv:3", "the same place as line 2"},
      RefusedRow{kGood, "677@,4000000,3,4", 30, "t.csv:2", "subtract the place of the datum"},
      RefusedRow{"s_m,curvature_per_m,w_tr_right_m,w_tr_left_m", "5,0,3,4", 30, "t.csv:3",
                 "does not increase from line 2"},
      RefusedRow{"s_m,curvature_per_m,w_tr_right_m,w_tr_left_m", "-@,0,3,4", 30, "t.csv:3",
                 "does not increase"},
      RefusedRow{"x_m,y_m,w_tr_right_m,w_tr_left_m,bank_deg", "@,2,3,4,60", 30, "t.csv:2",
                 "beyond 45 degrees"},
  };
  for (const RefusedRow& r : refusals) {
    const auto csv = read_track_csv(std::string(r.header) + "\n" + rows(r.row, r.count), "t.csv");
    ASSERT_FALSE(csv) << r.reason;
    EXPECT_EQ(csv.error().place, r.place) << to_string(csv.error());
    EXPECT_NE(csv.error().what.find(r.reason), std::string::npos) << to_string(csv.error());
  }
}

TEST(TrackCsv, RefusesAHugeFileAtOnce) {
  const auto csv = read_track_csv(std::string(kMaxCsvBytes + 1, 'x'), "t.csv");
  ASSERT_FALSE(csv);
  EXPECT_NE(csv.error().what.find("8 MB"), std::string::npos);
}

// Whatever the bytes, it is a Result: a good file cut off anywhere and with any byte turned.
TEST(TrackCsv, DamagedFilesAreReadOrRefused) {
  const std::string good = csv_text(stadium(25.0));
  for (std::size_t i = 0; i < good.size(); i += 7) {
    (void)read_track_csv(good.substr(0, i), "t.csv");
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x95);
    const auto csv = read_track_csv(bad, "t.csv");
    EXPECT_TRUE(csv || csv.error().place.starts_with("t.csv:"));
  }
}

}  // namespace
}  // namespace pitwall::track_file
