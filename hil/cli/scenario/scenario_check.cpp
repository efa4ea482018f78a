// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/scenario/scenario_check.hpp"

#include "basestation/inputs/text_command.hpp"
#include "hil/bench/fault_plan.hpp"
#include "hil/bench/loading.hpp"
#include "hil/bench/rig.hpp"
#include "hil/bench/signals.hpp"

namespace pitwall::cli {
namespace {

// A fault or an expectation that neither bench has.
std::optional<Problem> refused_by_both(const scenario::Scenario& scenario) {
  using enum bench::BenchMode;
  if (!bench::refused_by(kLive, scenario.faults) && !bench::unjudged_by(kLive, scenario))
    return std::nullopt;
  return bench::refused_by(kLockstep, scenario.faults);
}

std::optional<Problem> problem_of(const bench::Loaded& loaded, const std::string& name) {
  const scenario::Scenario& scenario = loaded.scenario;
  if (const auto expectations = bench::expectations_of(scenario); !expectations)
    return expectations.error();
  if (const auto faults = bench::plan_faults(scenario.faults, scenario.seed); !faults)
    return faults.error();
  if (auto problem = bench::dust_in_rays(scenario)) return problem;
  if (auto problem = refused_by_both(scenario)) return problem;
  for (const scenario::OperatorText& entry : scenario.operator_texts)
    if (const auto read = inputs::parse_text_command(entry.text); !read)
      return Problem{name, "operator: \"" + entry.text + "\": " + read.error().what};
  if (const auto rig = bench::Rig::build(scenario, loaded.setup.track); !rig) return rig.error();
  return std::nullopt;
}

}  // namespace

std::optional<Problem> problem_in(const std::string& scenario_file) {
  const auto loaded = bench::load(scenario_file, "");
  return loaded ? problem_of(*loaded, scenario_file) : loaded.error();
}

std::optional<Problem> problem_in_text(const std::string& text, const std::string& name) {
  const auto loaded = bench::load_text(text, name, "");
  return loaded ? problem_of(*loaded, name) : loaded.error();
}

}  // namespace pitwall::cli
