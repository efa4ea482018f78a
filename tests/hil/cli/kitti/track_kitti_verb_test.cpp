// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/kitti/track_kitti_verb.hpp"

#include <gtest/gtest.h>

#include "protocol/vocabulary/text.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

class TrackKittiVerb : public ProgramRun {
 protected:
  // A car that comes nearer at 5 m/s, for 20 frames.
  std::string sequence() {
    std::string text;
    for (int frame = 0; frame < 20; ++frame)
      text += formatted("%d,2,1,2,3,4,9.5,1.5,1.7,4.2,2.0,1.7,%.2f,-1.57,-1.6\n", frame,
                        40.0 - 0.5 * frame);
    EXPECT_TRUE(transport::write_file(path("0000.txt"), text));
    return path("0000.txt");
  }
};

TEST_F(TrackKittiVerb, WritesATrackWithOneNumber) {
  for (const std::string tracker : {"paper", "road"}) {
    const ProgramOutput output =
        run({"track-kitti", sequence(), "--tracker", tracker, "--out", path("tracks.txt")});
    ASSERT_EQ(output.code, 0) << output.err;
    EXPECT_NE(output.out.find("20 frames, 20 detections, 1 tracks in"), std::string::npos)
        << output.out;
    EXPECT_NE(output.out.find("us of processor time a frame"), std::string::npos);
    const std::string tracks = text_of("tracks.txt");
    const auto last = tracks.rfind("\n19 ");
    ASSERT_NE(last, std::string::npos) << tracks;
    unsigned frame = 0, id = 0, first_frame = 0, first_id = 0;
    double v[13]{};
    ASSERT_EQ(std::sscanf(tracks.c_str() + last,
                          "%u %u Car 0 0 %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf",
                          &frame, &id, &v[0], &v[1], &v[2], &v[3], &v[4], &v[5], &v[6], &v[7],
                          &v[8], &v[9], &v[10], &v[11], &v[12]),
              15);
    ASSERT_EQ(std::sscanf(tracks.c_str(), "%u %u Car", &first_frame, &first_id), 2);
    EXPECT_EQ(id, first_id);
    EXPECT_LE(first_frame, 2U);
    EXPECT_NEAR(v[8], 2.0, 0.5);          // x
    EXPECT_NEAR(v[10], 40.0 - 9.5, 0.5);  // z
    EXPECT_NEAR(v[12], 9.5, 1e-6);        // score
  }
}

TEST_F(TrackKittiVerb, BadInputIsToldWithItsLine) {
  const std::string good = sequence(), out = path("tracks.txt");
  expect_refusal({"track-kitti", good, "--tracker", "best", "--out", out}, "paper or road");
  expect_refusal({"track-kitti", good, "--tracker", "road"}, "--out");
  expect_refusal({"track-kitti", path("none.txt"), "--tracker", "road", "--out", out}, "none.txt");
  ASSERT_TRUE(transport::write_file(path("bad.txt"), text_of("0000.txt") + "20,2,1\n"));
  expect_refusal({"track-kitti", path("bad.txt"), "--tracker", "road", "--out", out},
                 "bad.txt:21: error: 3 fields");
  EXPECT_FALSE(exists("tracks.txt"));
}

}  // namespace
}  // namespace pitwall::cli
