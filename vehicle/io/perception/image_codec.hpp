// Pixels of a camera's message.
//   in     sensor_msgs/Image whose sizes fit (contradiction_of): rgb8, bgr8, rgba8, bgra8, mono8,
//          8UC1, 8UC3, or Bayer's mosaic of 8 bits in its four orders; sensor_msgs/CompressedImage
//          with JPEG
//   out    the image; of a mosaic, each block of four pixels has the colour of its four
//   errors nullptr: none; else why the image cannot be read, and the image is not to be used
//   cost   O(pixels); allocates only while images grow. JPEG by libturbojpeg
//   source encodings of sensor_msgs/image_encodings.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "protocol/ros/messages/sensor.hpp"
#include "vehicle/autonomy/perception/camera/image.hpp"

namespace pitwall::io {

inline constexpr std::size_t kImageSideMost_px = 8'192;

const char* read_image(const ros::Image& message, perception::Image& image);
const char* read_image(const ros::CompressedImage& message, perception::Image& image);

}  // namespace pitwall::io
