// Reference unit: a fixed piece of work to which the benchmarks compare the processor time of our
// code.
//   in     none
//   out    a number that depends on all of the work, so that the compiler cannot remove a part
//   invariants
//          each unit is the same work on every machine. It mixes the operations of our code, so
//          that other load on the same core or cache slows both alike: libm and divisions (tyres),
//          small dense matrices (filter), dependent reads of a table larger than the second-level
//          cache (tracks, windows), branches over bits (CAN, telemetry)
//   cost   about 50 us; 2 MiB
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

 private:
  static constexpr std::size_t kStates = 15;  // states of the spatial filter
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
