// Cases of a sweep's plan: which values and which seed each of them has.
//   in     plan
//   out    number of cases; of each its seed and settings, in the order of the parameters
//   law    a case depends on the plan and its number alone. Of kPairs every two values of two
//          parameters stand in one case at least, in a few more cases than the least
//   cost   O(parameters) a case; kPairs: O(cases x parameters^2 x values) once
//   source pairs: greedy, by the value that meets most that is new (D. Cohen et al.: The AETG
//          system, IEEE TSE 23(7), 1997)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hil/sweep/plan.hpp"
#include "protocol/yaml/edited.hpp"

namespace pitwall::sweep {

struct Case {
  std::size_t number = 0;
  // The parameters as they are here, then the scenario's seed, unless it is one of them.
  std::vector<yaml::Setting> settings{};
};

class Cases {
 public:
  explicit Cases(Plan plan);

  std::size_t size() const;
  Case at(std::size_t number) const;
  const Plan& plan() const { return plan_; }

 private:
  std::vector<std::string> values_of(std::size_t number) const;

  Plan plan_;
  std::vector<std::vector<std::size_t>> pairs_;  // kPairs: place of each parameter's value
};

}  // namespace pitwall::sweep
