// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/kitti/kitti_files.hpp"

#include <gtest/gtest.h>

namespace pitwall::cli {
namespace {

const std::string kLine =
    "3,2,458.03,182.39,568.59,217.02,12.74,1.41,1.64,4.47,-4.12,1.83,30.82,0.04,0.17\n";

TEST(KittiFiles, ReadsEveryColumn) {
  const auto read = read_kitti_detections("\n" + kLine + kLine, "0000.txt");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->type, KittiType::kCar);
  ASSERT_EQ(read->boxes.size(), 2U);
  const KittiBox& b = read->boxes[1];
  EXPECT_EQ(b.frame, 3U);
  EXPECT_EQ(b.image, (std::array<double, 4>{458.03, 182.39, 568.59, 217.02}));
  EXPECT_EQ(b.score, 12.74);
  EXPECT_EQ(b.height_m, 1.41);
  EXPECT_EQ(b.width_m, 1.64);
  EXPECT_EQ(b.length_m, 4.47);
  EXPECT_EQ(b.x_m, -4.12);
  EXPECT_EQ(b.y_m, 1.83);
  EXPECT_EQ(b.z_m, 30.82);
  EXPECT_EQ(b.rot_y_rad, 0.04);
  EXPECT_EQ(b.alpha_rad, 0.17);
}

TEST(KittiFiles, RefusesWithFileAndLine) {
  const auto refusal = [](std::string from, const std::string& to) {
    std::string bad = kLine;
    const auto at = bad.find(from);
    bad.replace(at, from.size(), to);
    const auto read = read_kitti_detections(kLine + bad, "d.txt");
    return read ? std::string("accepted") : to_string(read.error());
  };
  EXPECT_EQ(refusal("12.74", "high"), "d.txt:2: error: score is \"high\", expected a number");
  EXPECT_EQ(refusal("12.74", "nan"), "d.txt:2: error: score is \"nan\", expected a number");
  EXPECT_EQ(refusal("12.74", ""), "d.txt:2: error: score is \"\", expected a number");
  EXPECT_EQ(refusal("1.41", "-1.41"), "d.txt:2: error: h is -1.41, allowed 0.01 to 100");
  EXPECT_EQ(refusal("3,2,", "3.5,2,"), "d.txt:2: error: frame is 3.5, expected a whole number");
  EXPECT_EQ(refusal("3,2,", "3,4,"), "d.txt:2: error: type is 4, allowed 1 to 3");
  EXPECT_EQ(refusal("3,2,", "3,1,"),
            "d.txt:2: error: type is 1 after 2, expected one class in a file");
  EXPECT_EQ(refusal("3,2,", "2,2,"),
            "d.txt:2: error: frame is 2 after 3, expected frames in order");
  EXPECT_TRUE(refusal(",0.17", "").starts_with("d.txt:2: error: 14 fields, expected 15"))
      << refusal(",0.17", "");
  EXPECT_TRUE(refusal("0.17", "0.17,1").starts_with("d.txt:2: error: 16 fields, expected 15"));
  const auto empty = read_kitti_detections("\n", "d.txt");
  ASSERT_FALSE(empty);
  EXPECT_EQ(to_string(empty.error()), "d.txt: error: has no detections");
}

TEST(KittiFiles, WritesTheTracksAsTheEvaluationReadsThem) {
  const auto read = read_kitti_detections(kLine, "d.txt");
  ASSERT_TRUE(read);
  EXPECT_EQ(kitti_text(KittiType::kCar, std::vector<KittiTrack>{{7, read->boxes[0]}}),
            "3 7 Car 0 0 0.170000 458.030000 182.390000 568.590000 217.020000 1.410000 1.640000 "
            "4.470000 -4.120000 1.830000 30.820000 0.040000 12.740000\n");
}

}  // namespace
}  // namespace pitwall::cli
