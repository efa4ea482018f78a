// SPDX-License-Identifier: Apache-2.0
#include "hil/scenes/npy.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::scenes {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

constexpr std::string_view kMagic{"\x93NUMPY\x01\x00", 8};
constexpr std::size_t kAligned = 64;

template <class T>
constexpr std::string_view kKind = std::is_same_v<T, float>          ? "<f4"
                                   : std::is_same_v<T, std::uint8_t> ? "|u1"
                                                                     : "<u4";

// The header of an array of `rows`, as numpy.save writes it.
template <class T>
std::string header(std::size_t rows, std::size_t columns) {
  const std::string shape =
      columns == 1 ? formatted("(%zu,)", rows) : formatted("(%zu, %zu)", rows, columns);
  std::string dictionary = formatted("{'descr': '%s', 'fortran_order': False, 'shape': %s, }",
                                     std::string{kKind<T>}.c_str(), shape.c_str());
  const std::size_t before = kMagic.size() + sizeof(std::uint16_t);
  while ((before + dictionary.size() + 1) % kAligned != 0) dictionary += ' ';
  dictionary += '\n';
  std::string text{kMagic};
  text += static_cast<char>(dictionary.size() % 256);
  text += static_cast<char>(dictionary.size() / 256);
  return text + dictionary;
}

}  // namespace

template <class T>
std::string npy_text(std::span<const T> values, std::size_t columns) {
  CHECK(columns > 0 && values.size() % columns == 0);
  std::string text = header<T>(values.size() / columns, columns);
  const std::size_t before = text.size();
  text.resize(before + values.size_bytes());
  if (!values.empty()) std::memcpy(text.data() + before, values.data(), values.size_bytes());
  return text;
}

template <class T>
Result<std::vector<T>, Problem> read_npy(std::string_view file, const std::string& name,
                                         std::size_t columns) {
  const std::size_t begin = file.find('\n') + 1;
  if (!file.starts_with(kMagic) || begin == 0)
    return refuse(name, "expected an array of NumPy, version 1.0");
  const std::size_t bytes = file.size() - begin;
  const std::size_t rows = bytes / (columns * sizeof(T));
  // What it would begin with if it held so many rows of such numbers.
  const std::string expected = header<T>(rows, columns);
  if (rows * columns * sizeof(T) != bytes || file.substr(0, begin) != expected)
    return refuse(name, formatted("expected rows of %zu numbers %s, all of them", columns,
                                  std::string{kKind<T>}.c_str()));
  std::vector<T> values(rows * columns);
  if (!values.empty()) std::memcpy(values.data(), file.data() + begin, bytes);
  return values;
}

template std::string npy_text(std::span<const std::uint8_t>, std::size_t);
template std::string npy_text(std::span<const std::uint32_t>, std::size_t);
template std::string npy_text(std::span<const float>, std::size_t);
template Result<std::vector<std::uint8_t>, Problem> read_npy(std::string_view, const std::string&,
                                                             std::size_t);
template Result<std::vector<std::uint32_t>, Problem> read_npy(std::string_view, const std::string&,
                                                              std::size_t);
template Result<std::vector<float>, Problem> read_npy(std::string_view, const std::string&,
                                                      std::size_t);

}  // namespace pitwall::scenes
