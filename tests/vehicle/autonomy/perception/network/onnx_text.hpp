// A network of one layer as an ONNX file, written by hand: what a network of another shape is.
//   source onnx.proto3: numbers of the fields
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pitwall::perception {

namespace onnx_wire {

inline std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value >= 128; value >>= 7U) bytes += static_cast<char>(value % 128 + 128);
  return bytes + static_cast<char>(value);
}
inline std::string number(unsigned field, std::uint64_t value) {
  return varint(field * 8) + varint(value);
}
inline std::string part(unsigned field, std::string_view bytes) {
  return varint(field * 8 + 2) + varint(bytes.size()) + std::string{bytes};
}

inline std::string tensor(std::string_view name, const std::vector<std::uint64_t>& shape) {
  std::string dimensions;
  for (const std::uint64_t size : shape) dimensions += part(1, number(1, size));
  const std::string type = part(1, number(1, 1) + part(2, dimensions));  // 1: float
  return part(1, name) + part(2, type);
}

}  // namespace onnx_wire

// Its output is `operation` of its input and has the same shape.
inline std::string onnx_text(std::string_view operation, const std::vector<std::uint64_t>& shape) {
  using namespace onnx_wire;  // NOLINT: of this helper
  const std::string node =
      part(1, "planes") + part(2, "cars") + part(3, "layer") + part(4, operation);
  const std::string graph = part(1, node) + part(2, "graph") + part(11, tensor("planes", shape)) +
                            part(12, tensor("cars", shape));
  return number(1, 6) + part(7, graph) + part(8, number(2, 11));
}

}  // namespace pitwall::perception
