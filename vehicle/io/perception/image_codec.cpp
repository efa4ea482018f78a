// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/image_codec.hpp"

#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string_view>

namespace pitwall::io {
namespace {

struct Encoding {
  std::string_view name;
  std::size_t bytes;                   // of a pixel
  std::array<std::size_t, 3> channel;  // red, green, blue in them
};

constexpr std::array kEncodings{
    Encoding{"rgb8", 3, {0, 1, 2}},  Encoding{"bgr8", 3, {2, 1, 0}},
    Encoding{"8UC3", 3, {2, 1, 0}},  Encoding{"rgba8", 4, {0, 1, 2}},
    Encoding{"bgra8", 4, {2, 1, 0}}, Encoding{"mono8", 1, {0, 0, 0}},
    Encoding{"8UC1", 1, {0, 0, 0}},
};

// Of a block of two by two pixels: which row and column red and blue have.
struct Mosaic {
  std::string_view name;
  std::size_t red_row, red_column;
};

constexpr std::array kMosaics{Mosaic{"bayer_rggb8", 0, 0}, Mosaic{"bayer_bggr8", 1, 1},
                              Mosaic{"bayer_gbrg8", 1, 0}, Mosaic{"bayer_grbg8", 0, 1}};

bool has_sizes(std::uint64_t width, std::uint64_t height) {
  return width > 0 && height > 0 && width <= kImageSideMost_px && height <= kImageSideMost_px;
}

void set_size(perception::Image& image, std::size_t width_px, std::size_t height_px) {
  image.width_px = width_px, image.height_px = height_px;
  image.rgb.resize(3 * width_px * height_px);
}

void copy_pixels(const ros::Image& message, const Encoding& encoding, perception::Image& image) {
  std::uint8_t* to = image.rgb.data();
  for (std::size_t v = 0; v < image.height_px; ++v) {
    const std::uint8_t* from = message.data.data() + v * message.step;
    for (std::size_t u = 0; u < image.width_px; ++u, from += encoding.bytes)
      for (const std::size_t channel : encoding.channel) *to++ = from[channel];
  }
}

void copy_mosaic(const ros::Image& message, const Mosaic& mosaic, perception::Image& image) {
  const std::size_t red_row = mosaic.red_row, red_column = mosaic.red_column;
  for (std::size_t v = 0; v < image.height_px; ++v)
    for (std::size_t u = 0; u < image.width_px; ++u) {
      const std::size_t row = v - v % 2, column = u - u % 2;
      const auto at = [&](std::size_t down, std::size_t right) -> unsigned {
        return message.data[(row + down) * message.step + column + right];
      };
      std::uint8_t* const to = image.rgb.data() + 3 * (v * image.width_px + u);
      to[0] = static_cast<std::uint8_t>(at(red_row, red_column));
      to[1] = static_cast<std::uint8_t>(
          (at(red_row, 1 - red_column) + at(1 - red_row, red_column) + 1) / 2);
      to[2] = static_cast<std::uint8_t>(at(1 - red_row, 1 - red_column));
    }
}

struct Decompressor {
  std::unique_ptr<void, int (*)(void*)> handle{tjInitDecompress(), tjDestroy};
};

}  // namespace

const char* read_image(const ros::Image& message, perception::Image& image) {
  if (!has_sizes(message.width, message.height)) return "no such size of an image";
  if (const auto* const found =
          std::ranges::find(kEncodings, std::string_view{message.encoding}, &Encoding::name);
      found != kEncodings.end()) {
    if (message.step < found->bytes * message.width) return "a row is shorter than its pixels";
    set_size(image, message.width, message.height);
    copy_pixels(message, *found, image);
    return nullptr;
  }
  const auto* const found =
      std::ranges::find(kMosaics, std::string_view{message.encoding}, &Mosaic::name);
  if (found == kMosaics.end()) return "no such encoding";
  if (message.width % 2 != 0 || message.height % 2 != 0) return "a mosaic with half a block";
  set_size(image, message.width, message.height);
  copy_mosaic(message, *found, image);
  return nullptr;
}

const char* read_image(const ros::CompressedImage& message, perception::Image& image) {
  thread_local const Decompressor decompressor;
  int width = 0, height = 0, subsampling = 0, colours = 0;
  const auto bytes = static_cast<unsigned long>(message.data.size());
  if (tjDecompressHeader3(decompressor.handle.get(), message.data.data(), bytes, &width, &height,
                          &subsampling, &colours) != 0)
    return "no JPEG";
  if (width <= 0 || height <= 0 ||
      !has_sizes(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height)))
    return "no such size of an image";
  set_size(image, static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  if (tjDecompress2(decompressor.handle.get(), message.data.data(), bytes, image.rgb.data(), width,
                    0, height, TJPF_RGB, TJFLAG_STOPONWARNING) != 0)
    return "a damaged JPEG";
  return nullptr;
}

}  // namespace pitwall::io
