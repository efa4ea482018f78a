// Gates of processor time in reference units: a limit in time holds for the reference machine only;
// divided by the cost of a reference unit there, it holds for any machine.
//   in     for each gate: its cost and that of a reference unit beside it, both of this run; its
//          limit on the reference machine
//   out    a line for each gate with its verdict; JSON; whether all gates hold
//   invariants
//          a gate holds if and only if cost / unit <= limit / kReferenceUnit_us. Without a
//          measurement (no unit, no finite cost, no gate at all) it does not hold
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace pitwall::cost {

// Cost of a unit on the reference machine, for which the requirements were set: a virtual machine
// with two cores of an AMD EPYC (family 26, model 2), Linux 6.18, g++ 12 at -O2. Measured without
// other load between the ticks of `bench lockstep`, which also use the caches: the median of ten
// processes, whose results were 47.7 to 54.3. It was measured before any gate was judged by it.
inline constexpr double kReferenceUnit_us = 48.9;

constexpr double limit_units(double limit_us) { return limit_us / kReferenceUnit_us; }

struct CostGate {
  std::string what;
  double cost_us = 0.0, unit_us = 0.0;
  double limit_us = 0.0;  // on the reference machine

  double units() const;  // infinite without a measurement
  bool held() const { return units() <= limit_units(limit_us); }
};

class CostGates {
 public:
  void at_most(CostGate gate);
  void count(std::string what, bool held);  // a gate of something other than time
  bool held() const;
  std::string text() const;  // one line per gate
  std::string json() const;  // array of gates

 private:
  struct Row {
    CostGate cost;
    bool is_cost = true, held = false;
  };
  std::vector<Row> rows_;
};

}  // namespace pitwall::cost
