// Classical Runge-Kutta step of order 4 for a state that is a struct of doubles.
//   in     the state, its derivative as a function of the state, the step
//   out    the state after one step
//   errors none; order 4 only if the derivative is smooth
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>

namespace pitwall::plant {

// from + dt_s * rate, member by member.
template <class State>
State ahead(const State& from, const State& rate, double dt_s) {
  using Vector = std::array<double, sizeof(State) / sizeof(double)>;
  static_assert(sizeof(Vector) == sizeof(State));
  auto a = std::bit_cast<Vector>(from);
  const auto b = std::bit_cast<Vector>(rate);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += dt_s * b[i];
  return std::bit_cast<State>(a);
}

template <class State, class Derivative>
State runge_kutta_step(const State& s, Derivative derivative, double dt_s) {
  using Vector = std::array<double, sizeof(State) / sizeof(double)>;
  const State k1 = derivative(s);
  const State k2 = derivative(ahead(s, k1, 0.5 * dt_s));
  const State k3 = derivative(ahead(s, k2, 0.5 * dt_s));
  const State k4 = derivative(ahead(s, k3, dt_s));
  auto a = std::bit_cast<Vector>(k1);
  const auto b = std::bit_cast<Vector>(k2), c = std::bit_cast<Vector>(k3),
             d = std::bit_cast<Vector>(k4);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = (a[i] + 2.0 * (b[i] + c[i]) + d[i]) / 6.0;
  return ahead(s, std::bit_cast<State>(a), dt_s);
}

}  // namespace pitwall::plant
