// Convolutional trunk of the pillar network, run by OpenCV's DNN module.
//   in     the network as the bytes of an ONNX file; planes_of() a sweep or some of its rows
//   out    kPillarOutputs planes of rows / kStride x kOutColumns, see PillarOutput
//   errors load(): no ONNX, or its input or output has another shape
//   cost   run(): 25 ms of one processor for all rows. Allocates inside OpenCV
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_grid.hpp"

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

class PillarTrunk {
 public:
  static constexpr std::size_t kStride = 2;
  static constexpr std::size_t kOutRows = PillarGrid::kRows / kStride;
  static constexpr std::size_t kOutColumns = PillarGrid::kColumns / kStride;
  static constexpr std::size_t kOutCells = kOutRows * kOutColumns;

  // `name`: of the file, for the error. `rows`: of each input.
  static Result<PillarTrunk, Problem> load(std::string_view onnx, const std::string& name,
                                           std::size_t rows = PillarGrid::kRows);
  ~PillarTrunk();
  PillarTrunk(PillarTrunk&&) noexcept;
  PillarTrunk& operator=(PillarTrunk&&) noexcept;

  // `planes`: kPillarFeatures x rows x PillarGrid::kColumns.
  std::vector<float> run(std::vector<float>& planes);

 private:
  struct Net;
  explicit PillarTrunk(std::unique_ptr<Net> net);
  std::unique_ptr<Net> net_;
};

}  // namespace pitwall::perception
