// Prometheus text format: families of samples, each with one help and one type.
//   in     samples, in any order of their families
//   out    text format 0.0.4
//   invariants
//          a sample that is not a finite number is left out: an unknown value has no sample
//   cost   O(samples)
//   source Prometheus: exposition formats; promtool's lint: base units in words, counters _total
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pitwall::publishers::metrics {

inline constexpr std::string_view kContentType = "text/plain; version=0.0.4; charset=utf-8";

using Labels = std::vector<std::pair<std::string_view, std::string>>;
enum class Kind { kGauge, kCounter };

class Exposition {
 public:
  // The first call for a name decides its help.
  void add(Kind kind, std::string_view name, std::string_view help, const Labels& labels,
           double value);
  std::string text() const;

 private:
  struct Family {
    std::string name, head, samples;
  };
  std::vector<Family> families_;
};

// Name of a unit of the registry in metric names, and the factor to that unit: "kPa" is pascals,
// 1000.
struct UnitName {
  std::string_view unit, words, help;
  double factor = 1.0;
};
// Returns nullptr for a unit that the table does not have.
const UnitName* unit_name(std::string_view unit);

}  // namespace pitwall::publishers::metrics
