// Convolutional trunk of the camera's network.
//   in     planes_of() an image
//   out    kCameraOutputs planes of kOutRows x kOutColumns, see CameraOutput
//   errors as Network::load()
//   cost   28 ms of one processor
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/autonomy/perception/camera/image.hpp"
#include "vehicle/autonomy/perception/network/network.hpp"

namespace pitwall::perception {

// Of a cell of the output, which is four by four pixels.
enum class CameraOutput : std::uint8_t {
  kCar,  // logit: the middle of a car is here
  kRight,
  kDown,  // its place from the middle of the cell, in cells
  kWidth,
  kHeight,   // natural logarithm of the size of the box about the whole car, over 32 and 16 pixels
  kUpright,  // of the height of the car upright in its middle, over 16 pixels
};
inline constexpr std::size_t kCameraOutputs = 6;
inline constexpr double kBoxWidth_px = 32.0, kBoxHeight_px = 16.0, kUpright_px = 16.0;

struct CameraTrunk {
  static constexpr std::size_t kRows = 320, kColumns = 672;  // of the image that it sees
  static constexpr std::size_t kColours = 3, kStride = 4;
  static constexpr std::size_t kOutRows = kRows / kStride, kOutColumns = kColumns / kStride;
  static constexpr std::size_t kOutCells = kOutRows * kOutColumns;

  static Result<Network, Problem> load(std::string_view onnx, const std::string& name) {
    return Network::load(onnx, name, {kColours, kRows, kColumns},
                         {kCameraOutputs, kOutRows, kOutColumns});
  }
};

// Of an image of any size, which is scaled to the trunk's: the mean of the pixels that one covers.
std::vector<float> planes_of(const Image& image);

}  // namespace pitwall::perception
