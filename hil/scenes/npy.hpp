// Arrays of NumPy: files that hold one table of numbers.
//   format version 1.0: "\x93NUMPY", 1, 0, u16 length of the header, a Python dictionary with kind
//          of number, order and shape, padded to 64 bytes; then the numbers, little-endian
//   out    T is std::uint8_t, std::uint32_t or float
//   errors read_npy(): Problem with file: no such array, other numbers, another shape, cut short
//   source numpy.lib.format
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::scenes {

// `columns`: of a row; 1: the array has one axis.
template <class T>
std::string npy_text(std::span<const T> values, std::size_t columns);

template <class T>
Result<std::vector<T>, Problem> read_npy(std::string_view file, const std::string& name,
                                         std::size_t columns);

}  // namespace pitwall::scenes
