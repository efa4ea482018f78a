// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/cases.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/random.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::sweep {
namespace {

constexpr std::string_view kSeedPath = "seed";
constexpr std::uint64_t kSeeds = 1'000'000'000;

// Which pairs of values of two parameters stand in a case already.
class PairCoverage {
 public:
  explicit PairCoverage(const std::vector<Parameter>& parameters) : parameters_(parameters) {
    for (std::size_t a = 0; a < parameters.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const std::size_t pairs = parameters[a].values.size() * parameters[b].values.size();
        covered_.emplace_back(pairs, false);
        uncovered_ += pairs;
      }
  }

  std::size_t uncovered() const { return uncovered_; }
  bool is_covered(std::size_t a, std::size_t value_a, std::size_t b, std::size_t value_b) const {
    return covered_[table(a, b)][value_a * parameters_[b].values.size() + value_b];
  }
  void cover(const std::vector<std::size_t>& row) {
    for (std::size_t a = 0; a < row.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        auto met = covered_[table(a, b)].begin() +
                   static_cast<std::ptrdiff_t>(row[a] * parameters_[b].values.size() + row[b]);
        if (!*met) --uncovered_;
        *met = true;
      }
  }
  // The first pair that does not; those before it do for good.
  std::array<std::size_t, 4> first_uncovered() {
    for (; a_ < parameters_.size(); ++a_, b_ = 0)
      for (; b_ < a_; ++b_, at_ = 0) {
        const std::vector<bool>& met = covered_[table(a_, b_)];
        while (at_ < met.size() && met[at_]) ++at_;
        const std::size_t of_b = parameters_[b_].values.size();
        if (at_ < met.size()) return {a_, at_ / of_b, b_, at_ % of_b};
      }
    return {};
  }

 private:
  static std::size_t table(std::size_t a, std::size_t b) { return a * (a - 1) / 2 + b; }

  const std::vector<Parameter>& parameters_;
  std::vector<std::vector<bool>> covered_;
  std::size_t uncovered_ = 0;
  std::size_t a_ = 1, b_ = 0, at_ = 0;  // where first_uncovered() goes on
};

std::string drawn_value(const Parameter& parameter, Random& random) {
  if (!parameter.values.empty()) return parameter.values[random.below(parameter.values.size())];
  return formatted("%.6g", random.between(parameter.from, parameter.to));
}

constexpr std::size_t kOpen = std::numeric_limits<std::size_t>::max();

// The value of parameter `a` that meets most new ones of those that are settled.
std::size_t best_value(const PairCoverage& coverage, const std::vector<Parameter>& parameters,
                       const std::vector<std::size_t>& row, std::size_t a) {
  std::size_t best = 0, most = 0;
  for (std::size_t value = 0; value < parameters[a].values.size(); ++value) {
    std::size_t fresh = 0;
    for (std::size_t b = 0; b < row.size(); ++b) {
      if (b == a || row[b] == kOpen) continue;
      fresh += a > b ? !coverage.is_covered(a, value, b, row[b])
                     : !coverage.is_covered(b, row[b], a, value);
    }
    if (fresh > most) best = value, most = fresh;
  }
  return best;
}

std::vector<std::vector<std::size_t>> pairs_of(const std::vector<Parameter>& parameters) {
  std::vector<std::vector<std::size_t>> rows;
  if (parameters.size() == 1) {
    for (std::size_t value = 0; value < parameters[0].values.size(); ++value)
      rows.push_back({value});
    return rows;
  }
  PairCoverage coverage{parameters};
  while (coverage.uncovered() > 0) {
    std::vector<std::size_t> row(parameters.size(), kOpen);
    const auto [a, value_a, b, value_b] = coverage.first_uncovered();
    row[a] = value_a, row[b] = value_b;
    for (std::size_t k = 0; k < row.size(); ++k)
      if (row[k] == kOpen) row[k] = best_value(coverage, parameters, row, k);
    coverage.cover(row);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

Cases::Cases(Plan plan) : plan_(std::move(plan)) {
  if (plan_.combine == Combine::kPairs) pairs_ = pairs_of(plan_.parameters);
}

std::size_t Cases::size() const {
  if (plan_.combine == Combine::kDraw) return plan_.cases;
  if (plan_.combine == Combine::kPairs) return plan_.repeats * pairs_.size();
  std::size_t cases = plan_.repeats;
  for (const Parameter& parameter : plan_.parameters) cases *= parameter.values.size();
  return cases;
}

std::vector<std::string> Cases::values_of(std::size_t number) const {
  std::vector<std::string> values;
  Random random{mix_bits(plan_.seed + 1) ^ mix_bits(number)};
  std::size_t combination = number / plan_.repeats;
  for (std::size_t k = 0; k < plan_.parameters.size(); ++k) {
    const Parameter& parameter = plan_.parameters[k];
    const std::size_t count = parameter.values.size();
    switch (plan_.combine) {
      case Combine::kDraw:
        values.push_back(drawn_value(parameter, random));
        break;
      case Combine::kAll:
        values.push_back(parameter.values[combination % count]);
        combination /= count;
        break;
      case Combine::kPairs:
        values.push_back(parameter.values[pairs_[combination][k]]);
        break;
    }
  }
  return values;
}

Case Cases::at(std::size_t number) const {
  CHECK(number < size());
  Case out{.number = number, .settings = {}};
  const std::vector<std::string> values = values_of(number);
  for (std::size_t k = 0; k < values.size(); ++k)
    out.settings.push_back({plan_.parameters[k].path, values[k]});
  const bool has_seed = std::ranges::any_of(
      plan_.parameters, [](const Parameter& parameter) { return parameter.path == kSeedPath; });
  if (!has_seed) {
    Random random{mix_bits(plan_.seed) + number};
    out.settings.push_back({std::string{kSeedPath}, std::to_string(random.below(kSeeds))});
  }
  return out;
}

}  // namespace pitwall::sweep
