// What a reference unit costs in this run, taken now and then beside the thing that is measured.
//   in     take(): now is a good moment; again(): the same moments once more, as the thing measured
//          is done once more, and of each moment the least counts
//   out    processor time of one unit: the median of the moments; `spent`, all of it, for who
//          measures around it
//   units  processor time of the calling thread
//   invariants
//          what slows the thing measured (a neighbour in the cache or on the same core, a processor
//          that is clocked down, a slower machine) slows the unit likewise: their ratio stays
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/vocabulary/time.hpp"
#include "tests/benchmarks/cost/reference_kernel.hpp"

namespace pitwall::cost {

double microseconds_of(Duration duration);

class ReferenceCost {
 public:
  double take();  // the processor time of this one, us
  void again() { next_ = 0; }
  std::size_t count() const { return units_us_.size(); }
  double unit_us() const;  // 0 where none was taken
  Duration spent() const { return spent_; }

 private:
  ReferenceKernel kernel_;
  std::vector<double> units_us_;
  std::size_t next_ = 0;
  Duration spent_{};
};

}  // namespace pitwall::cost
