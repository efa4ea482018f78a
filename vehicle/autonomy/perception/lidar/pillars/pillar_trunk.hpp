// Convolutional trunk of the pillar network.
//   in     the network as the bytes of an ONNX file; planes_of() a sweep or some of its rows
//   out    kPillarOutputs planes of rows / kStride x kOutColumns, see PillarOutput
//   errors as Network::load()
//   cost   25 ms of one processor for all rows
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_grid.hpp"
#include "vehicle/autonomy/perception/network/network.hpp"

namespace pitwall::perception {

// Of a cell of the output, which is two by two cells of the input.
enum class PillarOutput : std::uint8_t {
  kCar,  // logit: the middle of a car is here
  kAhead,
  kLeft,  // its place from the middle of the cell, in cells
  kLength,
  kWidth,  // natural logarithm of the size over kCarLength_m, kCarWidth_m
  kSin,
  kCos,  // of twice the angle to the road
};
inline constexpr std::size_t kPillarOutputs = 7;
inline constexpr double kCarLength_m = 4.92, kCarWidth_m = 1.89;

struct PillarTrunk {
  static constexpr std::size_t kStride = 2;
  static constexpr std::size_t kOutRows = PillarGrid::kRows / kStride;
  static constexpr std::size_t kOutColumns = PillarGrid::kColumns / kStride;
  static constexpr std::size_t kOutCells = kOutRows * kOutColumns;

  // `name`: of the file, for the error. `rows`: of each input.
  static Result<Network, Problem> load(std::string_view onnx, const std::string& name,
                                       std::size_t rows = PillarGrid::kRows) {
    return Network::load(onnx, name, {kPillarFeatures, rows, PillarGrid::kColumns},
                         {kPillarOutputs, rows / kStride, kOutColumns});
  }
};

}  // namespace pitwall::perception
