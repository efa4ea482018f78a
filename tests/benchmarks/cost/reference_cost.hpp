// Cost of a reference unit in this run, measured at several moments beside the code under test.
//   in     take(): measures a unit at this moment; again(): starts a further pass over the same
//          moments, of which the smallest cost per moment counts
//   out    processor time of one unit: the median of the moments; `spent`, the processor time of
//          all measurements, for a caller that measures around them
//   units  processor time of the calling thread
//   invariants
//          a disturbance of the code under test (other load in the cache or on the same core, a
//          lower clock rate, a slower machine) slows the unit too, so that their ratio stays
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
  double take();  // returns the processor time of this unit, us
  void again() { next_ = 0; }
  std::size_t count() const { return units_us_.size(); }
  double unit_us() const;  // 0 without a measurement
  Duration spent() const { return spent_; }

 private:
  ReferenceKernel kernel_;
  std::vector<double> units_us_;
  std::size_t next_ = 0;
  Duration spent_{};
};

}  // namespace pitwall::cost
