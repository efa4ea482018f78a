// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/sweep/falsifier.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "hil/sweep/in_parallel.hpp"
#include "hil/sweep/search.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {
namespace {

class Falsifier {
 public:
  Falsifier(const SweepInputs& inputs, const FalsifyOptions& options)
      : inputs_(inputs), options_(options) {}

  std::optional<sweep::Case> run() {
    const sweep::Plan& plan = inputs_.cases.plan();
    const auto ranges =
        static_cast<std::size_t>(std::ranges::count_if(plan.parameters, is_searched));
    const std::vector<sweep::Evaluated> points =
        sweep::search({.parameters = ranges, .evaluations = options_.runs, .seed = plan.seed},
                      [this](std::span<const sweep::Point> batch) { return evaluate(batch); });
    for (std::size_t i = 0; i < points.size(); ++i)
      if (results_[i].verdict != sweep::CaseVerdict::kPassed &&
          results_[i].verdict != sweep::CaseVerdict::kRefused)
        return case_of(points[i].at, i);
    return std::nullopt;
  }

 private:
  // Of the scenario's own seed, unless the plan has another.
  sweep::Case case_of(const sweep::Point& at, std::size_t number) const {
    sweep::Case out{.number = number};
    std::size_t k = 0;
    for (const sweep::Parameter& parameter : inputs_.cases.plan().parameters) {
      std::string value;
      if (is_searched(parameter))
        value = formatted("%.6g", parameter.from + at[k++] * (parameter.to - parameter.from));
      else
        value = parameter.values.front();
      out.settings.push_back({parameter.path, value});
    }
    return out;
  }

  std::vector<sweep::Margins> evaluate(std::span<const sweep::Point> batch) {
    const std::size_t first = results_.size();
    results_.resize(first + batch.size());
    sweep::in_parallel(batch.size(), options_.threads, [&](std::size_t i) {
      results_[first + i] = run_case(inputs_, case_of(batch[i], first + i), options_.step);
    });
    std::vector<sweep::Margins> margins;
    for (std::size_t i = first; i < results_.size(); ++i)
      margins.push_back(margins_of(results_[i]));
    print(batch, first);
    return margins;
  }

  // What failed without a margin of its own is broken all the same.
  static sweep::Margins margins_of(const sweep::CaseResult& result) {
    sweep::Margins margins;
    for (const sweep::ExpectationMargin& of : result.margins) margins.push_back(of.margin);
    const bool is_failed = result.verdict == sweep::CaseVerdict::kFailed ||
                           result.verdict == sweep::CaseVerdict::kContact;
    if (is_failed && std::ranges::none_of(margins, [](double m) { return m < 0.0; }))
      margins.push_back(-1.0);
    return margins;
  }

  void print(std::span<const sweep::Point> batch, std::size_t first) const {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const sweep::CaseResult& result = results_[first + i];
      if (result.verdict == sweep::CaseVerdict::kPassed) continue;
      std::printf("run %zu %s:", first + i + 1, name_of(result.verdict));
      for (const yaml::Setting& of : case_of(batch[i], first + i).settings)
        std::printf(" %s = %s", of.path.c_str(), of.value.c_str());
      std::printf("%s%s\n", result.why.empty() ? "" : ": ", result.why.c_str());
      for (const sweep::ExpectationMargin& of : result.margins)
        if (!of.pass) std::printf("  margin %.4g: %s\n", of.margin, of.text.c_str());
    }
    std::printf("%zu of at most %zu runs, simulation\n", results_.size(), options_.runs);
    std::fflush(stdout);
  }

  const SweepInputs& inputs_;
  const FalsifyOptions& options_;
  std::vector<sweep::CaseResult> results_;
};

}  // namespace

bool is_searched(const sweep::Parameter& parameter) { return parameter.values.empty(); }

std::optional<sweep::Case> falsify(const SweepInputs& inputs, const FalsifyOptions& options) {
  return Falsifier{inputs, options}.run();
}

}  // namespace pitwall::cli
