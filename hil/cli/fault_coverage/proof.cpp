// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/fault_coverage/proof.hpp"

#include <algorithm>

#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/cli/fault_coverage/monitors_off.hpp"
#include "hil/cli/fault_coverage/text.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::fault_coverage {
namespace {

constexpr std::string_view kSeenPrefix = "seen_";

std::string monitor_name(world::Monitor monitor) {
  return std::string(world::kMonitorNames[static_cast<std::size_t>(monitor)]);
}

// The first verdict that failed, as the scenario with its consequences alone has it.
std::optional<Consequence> first_failed(const bench::RunResult& result) {
  for (const grading::Verdict& verdict : result.verdicts)
    if (!verdict.pass) return Consequence{result.scenario, verdict.text, verdict.reason};
  return std::nullopt;
}

}  // namespace

bool asks(const scenario::Scenario& scenario, world::Monitor monitor) {
  const std::string name = std::string(kSeenPrefix) + monitor_name(monitor);
  return std::ranges::any_of(scenario.expect, [&name](const grading::Expectation& asked) {
    return asked.kind == grading::Kind::kDetects && asked.condition.signal == name;
  });
}

bool is_consequence(const grading::Expectation& expectation) {
  return std::ranges::none_of(grading::conditions_of(expectation), [](const grading::Condition& c) {
    return c.signal.starts_with(kSeenPrefix);
  });
}

Result<std::optional<Consequence>, Problem> consequence_without(world::Monitor monitor,
                                                                const bench::Loaded& loaded) {
  bench::Loaded blind = loaded;
  std::erase_if(blind.scenario.expect,
                [](const grading::Expectation& e) { return !is_consequence(e); });
  world::MonitorSet off;
  off.add(monitor);
  switch_off(blind.setup.params, off);
  bool has_failed = false;
  bench::LockstepOptions options;
  options.over = [&has_failed](const bench::RunView& run) {
    const auto expectation_states = run.grader.expectation_states();
    has_failed =
        has_failed || std::ranges::find(expectation_states, grading::ExpectationState::kFailed) !=
                          expectation_states.end();
    return has_failed;
  };
  const auto result = bench::run_lockstep(blind.scenario, blind.setup, options);
  if (!result) return Unexpected{result.error()};
  if (!has_failed) return first_failed(*result);
  // What the rest of the run would have shown is no failure of a run that was cut short.
  for (const grading::Verdict& verdict : result->verdicts)
    if (!verdict.pass && verdict.first_violation)
      return std::optional{Consequence{result->scenario, verdict.text, verdict.reason}};
  return first_failed(*result);
}

std::string open_point(const Proof& proof) {
  const std::string name = monitor_name(proof.monitor);
  if (proof.asked.empty()) return name + " is asked for by no scenario";
  const bool listed = informs_only(proof.monitor) != nullptr;
  if (proof.proven() == !listed) return {};
  return name + (listed ? " is listed as one that informs only, and is proven"
                        : " changes nothing: unproven");
}

std::string to_text(const std::vector<Proof>& proofs) {
  constexpr const char* kRow = "%-17s %-26s %s\n";
  std::string out = formatted(kRow, "without", "scenario", "fails");
  for (const Proof& proof : proofs) {
    std::string name = monitor_name(proof.monitor);
    for (const Consequence& failed : proof.failed) {
      const std::string what = failed.expectation + ": " + failed.reason;
      out += formatted(kRow, name.c_str(), failed.scenario.c_str(), what.c_str());
      name.clear();
    }
    const InformsOnly* listed = informs_only(proof.monitor);
    if (proof.failed.empty() && listed != nullptr)
      out += formatted(kRow, name.c_str(), "informs only", std::string(listed->reason).c_str());
    if (const std::string open = open_point(proof); !open.empty())
      out += "UNPROVEN: " + open + "\n";
  }
  return out;
}

std::string json_of(const Proof& proof) {
  json::Array failed;
  for (const Consequence& c : proof.failed)
    failed.json(json::Object{}
                    .text("scenario", c.scenario)
                    .text("expectation", c.expectation)
                    .text("reason", c.reason)
                    .str());
  const InformsOnly* listed = informs_only(proof.monitor);
  return json::Object{}
      .text("monitor", monitor_name(proof.monitor))
      .json("asked", json_list(proof.asked))
      .json("failed", failed.str())
      .json("informs_only", listed != nullptr ? json::quoted(listed->reason) : "null")
      .str();
}

}  // namespace pitwall::fault_coverage
