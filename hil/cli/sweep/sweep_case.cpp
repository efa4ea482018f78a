// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/sweep/sweep_case.hpp"

#include <utility>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/text.hpp"
#include "protocol/yaml/edited.hpp"

namespace pitwall::cli {
namespace {

using sweep::CaseResult, sweep::CaseVerdict;

CaseVerdict verdict_of(const bench::RunResult& result) {
  if (result.passed()) return CaseVerdict::kPassed;
  return result.failed_by_contact() ? CaseVerdict::kContact : CaseVerdict::kFailed;
}

Result<bench::RunResult, Problem> run(const std::string& scenario_text, const std::string& name,
                                      const sweep::Case& of) {
  const auto text = yaml::with_settings(scenario_text, name, of.settings);
  if (!text) return Unexpected{text.error()};
  const auto loaded = bench::load_text(*text, name, "");
  if (!loaded) return Unexpected{loaded.error()};
  // The log is made for its digest, which names the run.
  return bench::run_lockstep(*loaded, {.log = [](std::span<const std::uint8_t>) { return true; }});
}

// The listed values, or both ends of the range.
std::vector<std::string> ends_of(const sweep::Parameter& parameter) {
  if (!parameter.values.empty()) return parameter.values;
  return {shortest(parameter.from), shortest(parameter.to)};
}

}  // namespace

CaseResult run_case(const std::string& scenario_text, const std::string& name,
                    const sweep::Case& of) {
  const Instant begun = transport::monotonic_now();
  const auto result = run(scenario_text, name, of);
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
