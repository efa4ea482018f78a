// Fixed piece of work, the reference unit, beside which the benchmarks weigh the processor time of
// ours.
//   in     nothing
//   out    a number that depends on all of the work, so that no compiler leaves any out
//   invariants
//          one unit is as much work as the next, on every machine. It mixes what our code does, so
//          that a neighbour on the same core or cache slows both alike: libm and divisions (tyres),
//          small dense matrices (filter), reads of a table larger than the second cache, each from
//          where the last one points (tracks, windows), branches over bits (CAN, telemetry)
//   cost   some 50 us; 2 MiB
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pitwall::cost {

class ReferenceKernel {
 public:
  ReferenceKernel();
  double run();

 public:
  static constexpr std::size_t kStates = 15;  // of the spatial filter
  static constexpr std::size_t kTable = 1 << 18;
  using Matrix = std::array<double, kStates * kStates>;

  double tyres() const;
  double matrices();
  double walk();
  double bits() const;

  Matrix transition_{}, start_{}, covariance_{}, product_{};
  std::vector<std::uint64_t> table_;
  std::uint64_t at_ = 0;
};

}  // namespace pitwall::cost
