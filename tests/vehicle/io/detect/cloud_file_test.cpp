// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/detect/cloud_file.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace pitwall::io {
namespace {

const std::string kHead =
    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity\n"
    "SIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
    "POINTS 2\n";

template <class Value>
void append(std::string& bytes, Value value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

std::string error_of(const std::string& bytes, const std::string& name = "a.pcd") {
  const auto cloud = parse_cloud(bytes, name);
  return cloud ? "" : to_string(cloud.error());
}

TEST(CloudFile, ReadsAnAsciiPcd) {
  const auto cloud = parse_cloud(kHead + "DATA ascii\n1 2 3 0.5\n-1e1 nan 4.25 7\n", "a.pcd");
  ASSERT_TRUE(cloud) << to_string(cloud.error());
  ASSERT_EQ(cloud->size(), 2U);
  EXPECT_EQ((*cloud)[0].x_m, 1.0F);
  EXPECT_EQ((*cloud)[0].y_m, 2.0F);
  EXPECT_EQ((*cloud)[0].z_m, 3.0F);
  EXPECT_EQ((*cloud)[0].intensity, 0.5F);
  EXPECT_EQ((*cloud)[1].x_m, -10.0F);
  EXPECT_TRUE((*cloud)[1].y_m != (*cloud)[1].y_m);
}

TEST(CloudFile, ReadsFieldsOfOtherTypesAndOrder) {
  std::string bytes =
      "FIELDS ring z normal x y\nSIZE 2 8 4 4 2\nTYPE U F F F I\nCOUNT 1 1 3 1 1\nPOINTS 2\n"
      "DATA binary\n";
  for (int i = 0; i < 2; ++i) {
    append(bytes, std::uint16_t{7});
    append(bytes, 1.5 + i);
    for (int k = 0; k < 3; ++k) append(bytes, 99.0F);
    append(bytes, -2.5F);
    append(bytes, static_cast<std::int16_t>(-300 - i));
  }
  const auto cloud = parse_cloud(bytes, "a.pcd");
  ASSERT_TRUE(cloud) << to_string(cloud.error());
  ASSERT_EQ(cloud->size(), 2U);
  EXPECT_EQ((*cloud)[1].x_m, -2.5F);
  EXPECT_EQ((*cloud)[1].y_m, -301.0F);
  EXPECT_EQ((*cloud)[1].z_m, 2.5F);
  EXPECT_EQ((*cloud)[1].intensity, 0.0F);
}

TEST(CloudFile, ReadsABinOfKitti) {
  std::string bytes;
  for (const float value : {1.0F, 2.0F, 3.0F, 0.25F, 4.0F, 5.0F, 6.0F, 0.75F}) append(bytes, value);
  const auto cloud = parse_cloud(bytes, "000000.bin");
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->size(), 2U);
  EXPECT_EQ((*cloud)[1].y_m, 5.0F);
  EXPECT_EQ((*cloud)[1].intensity, 0.75F);
  EXPECT_EQ(parse_cloud("", "empty.bin")->size(), 0U);
}

TEST(CloudFile, NamesThePlaceOfWhatIsWrong) {
  EXPECT_EQ(error_of("12345", "a.bin"),
            "a.bin: error: 5 bytes are no whole number of points of 16 bytes (x, y, z, intensity)");
  EXPECT_EQ(error_of("", "a.las"), "a.las: error: expected a .pcd or a .bin of KITTI");
  EXPECT_EQ(error_of(kHead), "a.pcd:10: error: no DATA in the head of a PCD");
  EXPECT_EQ(error_of("solid cube\n"), "a.pcd:1: error: 'solid' is no line of the head of a PCD");
  EXPECT_EQ(error_of(kHead + "DATA binary_compressed\n"),
            "a.pcd:11: error: expected DATA ascii or DATA binary");
  EXPECT_EQ(error_of(kHead + "DATA ascii\n1 2 3 4\n1 2 3\n"),
            "a.pcd:13: error: expected 4 values, got 3");
  EXPECT_EQ(error_of(kHead + "DATA ascii\n1 2 3 4\n1 two 3 4\n"),
            "a.pcd:13: error: 'two' is no number");
  EXPECT_EQ(error_of(kHead + "DATA ascii\n1 2 3 4\n"), "a.pcd:12: error: ends after 1 of 2 points");
  EXPECT_EQ(error_of(kHead + "DATA binary\n" + std::string(31, 'x')),
            "a.pcd:11: error: ends after 1 of 2 points");
  EXPECT_EQ(error_of("FIELDS x y\nPOINTS 1\nDATA ascii\n1 2\n"),
            "a.pcd:3: error: FIELDS without z");
  EXPECT_EQ(error_of("FIELDS x y z\nSIZE 4 4\n"),
            "a.pcd:2: error: SIZE: expected 3 values, one for each field");
  EXPECT_EQ(error_of("FIELDS x y z\nSIZE 4 4 3\nPOINTS 1\nDATA ascii\n"),
            "a.pcd:4: error: a type of z that no PCD has");
  EXPECT_EQ(error_of("FIELDS x y z\nTYPE F F Q\n"), "a.pcd:2: error: TYPE: expected I, U or F");
  EXPECT_EQ(error_of("FIELDS x y z\nPOINTS 99999999999\n"),
            "a.pcd:2: error: POINTS: expected a number, at most 10000000");
  EXPECT_EQ(error_of("POINTS 0\nDATA ascii\n"), "a.pcd:2: error: DATA before FIELDS");
}

TEST(CloudFile, ACutFileIsRefusedAtEveryByte) {
  const std::string whole = kHead + "DATA ascii\n1 2 3 0.5\n4 5 6 0.5\n";
  for (std::size_t size = 0; size + 4 < whole.size(); ++size)
    EXPECT_FALSE(parse_cloud(whole.substr(0, size), "a.pcd")) << size;
}

}  // namespace
}  // namespace pitwall::io
