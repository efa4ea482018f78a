// A convolutional network from planes to planes, run by OpenCV's DNN module.
//   in     the network as the bytes of an ONNX file, and the shapes that it must have
//   errors load(): no ONNX, or its input or output has another shape
//   cost   run(): that of its multiplications. Allocates inside OpenCV
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::perception {

struct PlanesShape {
  std::size_t planes = 0, rows = 0, columns = 0;

  std::size_t size() const { return planes * rows * columns; }
};

// Reads a file of weights.
using ReadFile = std::function<Result<std::string, Problem>(const std::string& path)>;

class Network {
 public:
  // `name`: of the file, for the error.
  static Result<Network, Problem> load(std::string_view onnx, const std::string& name,
                                       const PlanesShape& in, const PlanesShape& out);
  ~Network();
  Network(Network&&) noexcept;
  Network& operator=(Network&&) noexcept;

  // `planes` has the size of the input's shape.
  std::vector<float> run(std::vector<float>& planes);

 private:
  struct Net;
  explicit Network(std::unique_ptr<Net> net);
  std::unique_ptr<Net> net_;
};

}  // namespace pitwall::perception
