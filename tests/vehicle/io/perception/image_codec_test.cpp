// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/image_codec.hpp"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <cmath>
#include <string>

namespace pitwall::io {
namespace {

constexpr std::uint32_t kWidth = 6, kHeight = 4;

// Red, green, blue of a pixel of the image that all encodings show.
std::array<std::uint8_t, 3> colour(std::size_t u, std::size_t v) {
  return {static_cast<std::uint8_t>(10 * u), static_cast<std::uint8_t>(20 * v + 100),
          static_cast<std::uint8_t>(200 - u - v)};
}

// Rows are two bytes longer than their pixels.
ros::Image message(const std::string& encoding, const std::vector<std::size_t>& channels) {
  ros::Image made;
  made.width = kWidth, made.height = kHeight, made.encoding = encoding;
  made.step = static_cast<std::uint32_t>(kWidth * channels.size() + 2);
  made.data.resize(made.step * kHeight, 77);
  for (std::size_t v = 0; v < kHeight; ++v)
    for (std::size_t u = 0; u < kWidth; ++u)
      for (std::size_t c = 0; c < channels.size(); ++c)
        made.data[v * made.step + u * channels.size() + c] =
            channels[c] < 3 ? colour(u, v)[channels[c]] : 255;
  return made;
}

TEST(ImageCodec, ReadsTheColoursOfEachEncoding) {
  const std::vector<std::pair<std::string, std::vector<std::size_t>>> encodings{
      {"rgb8", {0, 1, 2}},     {"bgr8", {2, 1, 0}}, {"8UC3", {2, 1, 0}}, {"rgba8", {0, 1, 2, 3}},
      {"bgra8", {2, 1, 0, 3}}, {"mono8", {0}},      {"8UC1", {0}}};
  for (const auto& [encoding, channels] : encodings) {
    perception::Image image;
    ASSERT_EQ(read_image(message(encoding, channels), image), nullptr) << encoding;
    ASSERT_EQ(image.width_px, kWidth);
    ASSERT_EQ(image.height_px, kHeight);
    for (std::size_t v = 0; v < kHeight; ++v)
      for (std::size_t u = 0; u < kWidth; ++u)
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_EQ(image.pixel(u, v)[c], colour(u, v)[channels.size() == 1 ? 0 : c]) << encoding;
  }
}

// Each letter of the name is a pixel of the block, row by row.
TEST(ImageCodec, ReadsBayersMosaicInItsFourOrders) {
  for (const std::string order : {"rggb", "bggr", "gbrg", "grbg"}) {
    ros::Image made = message("bayer_" + order + "8", {0});
    for (std::size_t v = 0; v < kHeight; ++v)
      for (std::size_t u = 0; u < kWidth; ++u) {
        const char letter = order[2 * (v % 2) + u % 2];
        made.data[v * made.step + u] = letter == 'r' ? 200 : letter == 'b' ? 30 : v % 2 ? 90 : 110;
      }
    perception::Image image;
    ASSERT_EQ(read_image(made, image), nullptr) << order;
    for (std::size_t v = 0; v < kHeight; ++v)
      for (std::size_t u = 0; u < kWidth; ++u) {
        EXPECT_EQ(image.pixel(u, v)[0], 200) << order;
        EXPECT_EQ(image.pixel(u, v)[1], 100) << order;
        EXPECT_EQ(image.pixel(u, v)[2], 30) << order;
      }
  }
}

std::string refusal(const ros::Image& bad) {
  perception::Image image;
  const char* const why = read_image(bad, image);
  return why == nullptr ? "" : why;
}

TEST(ImageCodec, WhatIsNoImageIsRefusedWithAReason) {
  EXPECT_EQ(refusal(message("yuv422", {0, 1})), "no such encoding");
  ros::Image narrow = message("rgb8", {0, 1, 2});
  narrow.step = 17;
  EXPECT_EQ(refusal(narrow), "a row is shorter than its pixels");
  ros::Image empty = message("rgb8", {0, 1, 2});
  empty.width = 0;
  EXPECT_EQ(refusal(empty), "no such size of an image");
  ros::Image vast = message("rgb8", {0, 1, 2});
  vast.width = kImageSideMost_px + 1;
  EXPECT_EQ(refusal(vast), "no such size of an image");
  ros::Image odd = message("bayer_rggb8", {0});
  odd.width = 5;
  EXPECT_EQ(refusal(odd), "a mosaic with half a block");
}

ros::CompressedImage jpeg(const std::vector<std::uint8_t>& rgb, int width, int height) {
  ros::CompressedImage made;
  made.format = "rgb8; jpeg compressed bgr8";
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  void* const compressor = tjInitCompress();
  EXPECT_EQ(tjCompress2(compressor, rgb.data(), width, 0, height, TJPF_RGB, &bytes, &size,
                        TJSAMP_444, 95, 0),
            0);
  made.data.assign(bytes, bytes + size);
  tjFree(bytes);
  tjDestroy(compressor);
  return made;
}

TEST(ImageCodec, ReadsJpeg) {
  constexpr int kSide = 64;
  std::vector<std::uint8_t> rgb;
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u)
      for (const int part : {4 * u, 4 * v, 128}) rgb.push_back(static_cast<std::uint8_t>(part));
  const ros::CompressedImage message = jpeg(rgb, kSide, kSide);
  perception::Image image;
  ASSERT_EQ(read_image(message, image), nullptr);
  ASSERT_EQ(image.rgb.size(), rgb.size());
  for (std::size_t i = 0; i < rgb.size(); ++i)
    ASSERT_LT(std::abs(int{image.rgb[i]} - int{rgb[i]}), 12) << i;

  for (std::size_t kept : {std::size_t{0}, std::size_t{20}, message.data.size() / 2}) {
    ros::CompressedImage cut = message;
    cut.data.resize(kept);
    EXPECT_NE(read_image(cut, image), nullptr) << kept << " bytes";
  }
  ros::CompressedImage other = message;
  other.data.assign(500, 'x');
  EXPECT_STREQ(read_image(other, image), "no JPEG");
}

}  // namespace
}  // namespace pitwall::io
