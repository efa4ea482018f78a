// Vector of bounded size without heap: push() beyond the bound returns false, and the caller counts
// it. Trivially copyable if T is, so that a state with such a vector remains a plain value.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "protocol/vocabulary/check.hpp"

namespace pitwall {

template <class T, std::size_t N>
class FixedVector {
 public:
  static constexpr std::size_t capacity() { return N; }

  [[nodiscard]] constexpr bool push(const T& v) {
    if (size_ == N) return false;
    items_[size_++] = v;
    return true;
  }
  constexpr void clear() { size_ = 0; }
  constexpr std::size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr bool full() const { return size_ == N; }
  constexpr T& operator[](std::size_t i) { return CHECK(i < size_), items_[i]; }
  constexpr const T& operator[](std::size_t i) const { return CHECK(i < size_), items_[i]; }
  constexpr const T& back() const { return (*this)[size_ - 1]; }
  constexpr T* begin() { return items_.data(); }
  constexpr T* end() { return items_.data() + size_; }
  constexpr const T* begin() const { return items_.data(); }
  constexpr const T* end() const { return items_.data() + size_; }
  constexpr std::span<const T> span() const { return {items_.data(), size_}; }

 private:
  std::array<T, N> items_{};
  std::size_t size_ = 0;
};

}  // namespace pitwall
