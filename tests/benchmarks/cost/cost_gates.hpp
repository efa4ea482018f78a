// Gates of processor time in reference units: a requirement in time is met on one machine, the
// reference machine; in the units that it is there, it holds on any.
//   in     for each gate: its cost and that of a reference unit beside it, both of this run; its
//          limit on the reference machine
//   out    a line for each gate with its verdict; JSON; whether all hold
//   invariants
//          held exactly where cost / unit <= limit / kReferenceUnit_us. Nothing that was not
//          measured (no unit, no finite cost, no gate at all) is held
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace pitwall::cost {

// The reference machine is the one that the requirements were set on: a virtual machine with two
// cores of an AMD EPYC (family 26, model 2), Linux 6.18, g++ 12 at -O2. A unit there, with nobody
// else on it, between the ticks of `bench lockstep`, where the caches are not the unit's own: the
// median of ten processes, which had 47.7 to 54.3. Taken before any gate was judged by it.
inline constexpr double kReferenceUnit_us = 48.9;

constexpr double limit_units(double limit_us) { return limit_us / kReferenceUnit_us; }

struct CostGate {
  std::string what;
  double cost_us = 0.0, unit_us = 0.0;
  double limit_us = 0.0;  // on the reference machine

  double units() const;  // infinite where nothing was measured
  bool held() const { return units() <= limit_units(limit_us); }
};

class CostGates {
 public:
  void at_most(CostGate gate);
  void count(std::string what, bool held);  // of something else than time
  bool held() const;
  std::string text() const;  // lines
  std::string json() const;  // an array

 private:
  struct Row {
    CostGate cost;
    bool is_cost = true, held = false;
  };
  std::vector<Row> rows_;
};

}  // namespace pitwall::cost
