// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/track_verb.hpp"

#include <gtest/gtest.h>

#include "tests/hil/cli/program_run.hpp"
#include "tests/hil/track_file/csv_text.hpp"

namespace pitwall::cli {
namespace {

class TrackVerb : public ProgramRun {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    EXPECT_TRUE(transport::write_file(path(name), text));
    return path(name);
  }
  std::string stadium() { return file("stadium.csv", track_file::csv_text(track_file::stadium())); }
};

TEST_F(TrackVerb, WrongUsageIsTold) {
  expect_refusal({"track"}, "subcommand");
  expect_refusal({"track", "check"}, "FILE");
  expect_refusal({"track", "import", stadium()}, "--out");
  expect_refusal({"track", "import", stadium(), "--out", path("t.yaml"), "--smooth", "900"}, "900");
  expect_refusal({"track", "picture", path("none.yaml"), "--out", path("t.svg")}, "none.yaml");
  expect_refusal({"track", "import", "vehicle/config/tracks/tms.yaml", "--out", path("t.yaml")},
                 "a track file already");
  EXPECT_FALSE(exists("t.yaml"));
  EXPECT_FALSE(exists("t.svg"));
}

TEST_F(TrackVerb, BadFilesAreRefusedWithTheirLine) {
  expect_refusal({"track", "check", file("a.csv", "x_m,y_m,breite\n")}, "a.csv:1");
  expect_refusal({"track", "check", file("b.yaml", "name: x\nlength_m: -1\n")}, "b.yaml:2");
}

TEST_F(TrackVerb, ChecksATrackThatShips) {
  const ProgramOutput output =
      run({"track", "check", "vehicle/config/tracks/lvms.yaml", "--json", path("t.json")});
  EXPECT_EQ(output.code, 0) << output.err;
  EXPECT_NE(output.out.find("LVMS: 2454.3 m"), std::string::npos) << output.out;
  EXPECT_NE(output.out.find("0 warnings"), std::string::npos) << output.out;
  EXPECT_NE(text_of("t.json").find("\"length_m\": 2454.3"), std::string::npos);
}

// From the CSV to a file, a picture, and laps on it.
TEST_F(TrackVerb, AnImportedTrackIsDriven) {
  const ProgramOutput output = run(
      {"track", "import", stadium(), "--out", path("stadium.yaml"), "--datum", "36.2,-115.0,600"});
  ASSERT_EQ(output.code, 0) << output.err;
  EXPECT_EQ(output.out.find("note: no --datum"), std::string::npos);
  EXPECT_NE(text_of("stadium.yaml").find("latitude_deg: 36.2"), std::string::npos);
  EXPECT_EQ(run({"track", "picture", path("stadium.yaml"), "--out", path("t.svg")}).code, 0);
  EXPECT_NE(text_of("t.svg").find("</svg>"), std::string::npos);
  const ProgramOutput laps = run({"laps", "--track", path("stadium.yaml"), "--only", "nominal"},
                                 PITWALL_BENCHMARKS_PROGRAM);
  EXPECT_EQ(laps.code, 0) << laps.out << laps.err;
  EXPECT_NE(laps.out.find("lapped"), std::string::npos) << laps.out;
}

}  // namespace
}  // namespace pitwall::cli
