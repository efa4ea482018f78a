// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/sweep/sweep_case.hpp"

#include <utility>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"
#include "protocol/yaml/edited.hpp"

namespace pitwall::cli {
namespace {

using sweep::CaseResult, sweep::CaseVerdict;

CaseVerdict verdict_of(const bench::RunResult& result) {
  if (result.passed()) return CaseVerdict::kPassed;
  return result.failed_by_contact() ? CaseVerdict::kContact : CaseVerdict::kFailed;
}

Result<bench::RunResult, Problem> run(const SweepInputs& inputs, const sweep::Case& of,
                                      const bench::StepFunction& step) {
  const std::string& name = inputs.cases.plan().scenario_file;
  const auto text = yaml::with_settings(inputs.scenario_text, name, of.settings);
  if (!text) return Unexpected{text.error()};
  const auto loaded = bench::load_text(*text, name, "");
  if (!loaded) return Unexpected{loaded.error()};
  // The log is made for its digest, which names the run.
  return bench::run_lockstep(
      *loaded, {.log = [](std::span<const std::uint8_t>) { return true; }, .step = step});
}

// The listed values, or both ends of the range.
std::vector<std::string> ends_of(const sweep::Parameter& parameter) {
  if (!parameter.values.empty()) return parameter.values;
  return {shortest(parameter.from), shortest(parameter.to)};
}

}  // namespace

Result<SweepInputs, Problem> read_sweep(const std::string& plan_file) {
  auto plan_text = transport::read_file(plan_file);
  if (!plan_text) return Unexpected{plan_text.error()};
  auto plan = sweep::read_plan(*plan_text, plan_file);
  if (!plan) return Unexpected{plan.error()};
  auto scenario_text = transport::read_file(plan->scenario_file);
  if (!scenario_text) return Unexpected{scenario_text.error()};
  return SweepInputs{sweep::Cases{*std::move(plan)}, *std::move(plan_text),
                     *std::move(scenario_text)};
}

CaseResult run_case(const SweepInputs& inputs, const sweep::Case& of,
                    const bench::StepFunction& step) {
  const Instant begun = transport::monotonic_now();
  const auto result = run(inputs, of, step);
  CaseResult out{.number = of.number, .verdict = CaseVerdict::kRefused};
  out.wall_s = (transport::monotonic_now() - begun).seconds();
  if (!result) {
    out.why = to_string(result.error());
    return out;
  }
  out.verdict = verdict_of(*result);
  out.digest = result->digest, out.simulated_s = result->simulated_s;
  for (const grading::Verdict& verdict : result->verdicts)
    out.margins.push_back({verdict.text, verdict.margin, verdict.pass});
  return out;
}

Result<bool, Problem> check_values(const std::string& scenario_text, const sweep::Plan& plan) {
  std::vector<yaml::Setting> settings;
  for (const sweep::Parameter& parameter : plan.parameters)
    settings.push_back({parameter.path, ends_of(parameter).front()});
  for (std::size_t k = 0; k < settings.size(); ++k) {
    const std::string first = settings[k].value;
    for (const std::string& value : ends_of(plan.parameters[k])) {
      settings[k].value = value;
      const auto text = yaml::with_settings(scenario_text, plan.scenario_file, settings);
      if (!text) return Unexpected{text.error()};
      const std::string name = settings[k].path + " = " + value + " in " + plan.scenario_file;
      const auto scenario = scenario::read_scenario(*text, name);
      if (!scenario) return Unexpected{scenario.error()};
    }
    settings[k].value = first;
  }
  return true;
}

}  // namespace pitwall::cli
