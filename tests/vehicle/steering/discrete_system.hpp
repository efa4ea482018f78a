// Discrete linear systems of one tick, x+ = a x + b u, y = c x + d u: conversion from differential
// equations with zero-order hold, and frequency response. For small matrices; no library, so that
// they are fast enough with -Og.
//   source Franklin, Powell, Workman, Digital Control of Dynamic Systems, 3rd ed., sec. 4.3 (hold)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>

namespace pitwall::steering::testing {

template <std::size_t kRows, std::size_t kColumns, class Number = double>
using Matrix = std::array<std::array<Number, kColumns>, kRows>;

template <std::size_t kStates, std::size_t kIns, std::size_t kOuts>
struct DiscreteSystem {
  Matrix<kStates, kStates> a{};
  Matrix<kStates, kIns> b{};
  Matrix<kOuts, kStates> c{};
  Matrix<kOuts, kIns> d{};
};

template <std::size_t kSize>
Matrix<kSize, kSize> product(const Matrix<kSize, kSize>& left, const Matrix<kSize, kSize>& right) {
  Matrix<kSize, kSize> out{};
  for (std::size_t i = 0; i < kSize; ++i)
    for (std::size_t k = 0; k < kSize; ++k)
      for (std::size_t j = 0; j < kSize; ++j) out[i][j] += left[i][k] * right[k][j];
  return out;
}

// Matrix exponential by scaling and squaring: its series for a part of the time, then squared.
template <std::size_t kSize>
Matrix<kSize, kSize> exponential(Matrix<kSize, kSize> m) {
  constexpr int kSquarings = 8, kTerms = 16;
  Matrix<kSize, kSize> sum{}, term{};
  for (std::size_t i = 0; i < kSize; ++i) sum[i][i] = term[i][i] = 1.0;
  for (auto& row : m)
    for (double& value : row) value = std::ldexp(value, -kSquarings);
  for (int k = 1; k <= kTerms; ++k) {
    term = product(term, m);
    for (std::size_t i = 0; i < kSize; ++i)
      for (std::size_t j = 0; j < kSize; ++j) sum[i][j] += term[i][j] /= k;
  }
  for (int k = 0; k < kSquarings; ++k) sum = product(sum, sum);
  return sum;
}

// x' = a x + b u with u held over the tick.
template <std::size_t kStates, std::size_t kOuts>
DiscreteSystem<kStates, 1, kOuts> held(const Matrix<kStates, kStates>& a,
                                       const std::array<double, kStates>& b,
                                       const Matrix<kOuts, kStates>& c, double tick_s) {
  Matrix<kStates + 1, kStates + 1> both{};
  for (std::size_t i = 0; i < kStates; ++i) {
    for (std::size_t j = 0; j < kStates; ++j) both[i][j] = a[i][j] * tick_s;
    both[i][kStates] = b[i] * tick_s;
  }
  both = exponential(both);
  DiscreteSystem<kStates, 1, kOuts> out;
  out.c = c;
  for (std::size_t i = 0; i < kStates; ++i) {
    for (std::size_t j = 0; j < kStates; ++j) out.a[i][j] = both[i][j];
    out.b[i][0] = both[i][kStates];
  }
  return out;
}

// Without the cases of infinite parts that operator* looks for.
inline std::complex<double> times(std::complex<double> left, std::complex<double> right) {
  return {left.real() * right.real() - left.imag() * right.imag(),
          left.real() * right.imag() + left.imag() * right.real()};
}

// c (z - a)^-1 b + d, by elimination with pivots.
template <std::size_t kStates, std::size_t kIns, std::size_t kOuts>
Matrix<kOuts, kIns, std::complex<double>> response(
    const DiscreteSystem<kStates, kIns, kOuts>& system, std::complex<double> z) {
  constexpr std::size_t kWidth = kStates + kIns;
  Matrix<kStates, kWidth, std::complex<double>> m{};
  for (std::size_t i = 0; i < kStates; ++i) {
    for (std::size_t j = 0; j < kStates; ++j) m[i][j] = (i == j ? z : 0.0) - system.a[i][j];
    for (std::size_t j = 0; j < kIns; ++j) m[i][kStates + j] = system.b[i][j];
  }
  for (std::size_t k = 0; k < kStates; ++k) {
    const auto larger = [k](const auto& one, const auto& other) {
      return std::norm(one[k]) < std::norm(other[k]);
    };
    std::swap(m[k], *std::max_element(m.begin() + static_cast<std::ptrdiff_t>(k), m.end(), larger));
    const std::complex<double> inverse = 1.0 / m[k][k];
    for (std::size_t j = k + 1; j < kWidth; ++j) m[k][j] = times(m[k][j], inverse);
    for (std::size_t i = k + 1; i < kStates; ++i) {
      const std::complex<double> factor = m[i][k];
      if (factor == 0.0) continue;
      for (std::size_t j = k + 1; j < kWidth; ++j) m[i][j] -= times(factor, m[k][j]);
    }
  }
  Matrix<kOuts, kIns, std::complex<double>> out{};
  for (std::size_t j = 0; j < kIns; ++j) {
    for (std::size_t k = kStates; k-- > 0;)
      for (std::size_t i = 0; i < k; ++i) m[i][kStates + j] -= times(m[i][k], m[k][kStates + j]);
    for (std::size_t o = 0; o < kOuts; ++o) {
      out[o][j] = system.d[o][j];
      for (std::size_t k = 0; k < kStates; ++k) out[o][j] += system.c[o][k] * m[k][kStates + j];
    }
  }
  return out;
}

}  // namespace pitwall::steering::testing
