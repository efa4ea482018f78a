// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/fault_coverage/fault_matrix.hpp"

#include <algorithm>
#include <cctype>

#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/cli/fault_coverage/catalogue.hpp"
#include "hil/cli/fault_coverage/monitors_off.hpp"
#include "hil/cli/fault_coverage/text.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::fault_coverage {
namespace {

constexpr std::string_view kSeen = "seen_";

Detection detection(const grading::Expectation& asked, const grading::Verdict& verdict) {
  const std::string& signal = asked.condition.signal;
  return {
      .by = signal.starts_with(kSeen) ? signal.substr(kSeen.size()) : to_string(asked.condition),
      .delay = verdict.delay,
      .deadline = asked.limit,
      .passed = verdict.pass,
      .reason = verdict.reason};
}

std::string milliseconds_of(Duration d) { return formatted("%.0f", d.milliseconds()); }

std::string json_of(const Detection& d) {
  return json::Object{}
      .text("by", d.by)
      .number("delay_s", d.delay ? d.delay->seconds() : kUnset)
      .number("deadline_s", d.deadline.seconds())
      .flag("passed", d.passed)
      .str();
}

std::string json_of(const FaultRow& row) {
  json::Array detections;
  for (const Detection& d : row.detections) detections.json(json_of(d));
  return json::Object{}
      .text("id", row.id)
      .text("scenario", row.scenario)
      .flag("passed", row.passed())
      .json("detections", detections.str())
      .text("outcome", row.outcome)
      .json("failed", json_list(row.failed))
      .str();
}

std::string lines_of(const FaultRow& row) {
  constexpr const char* kLine = "%-4s %-28s %-24s %6s %6s  %s\n";
  std::string out;
  bool first = true;
  for (const Detection& d : row.detections) {
    const std::string delay = d.delay ? milliseconds_of(*d.delay) : std::string("-");
    const std::string verdict = d.passed ? "" : "MISSED: " + d.reason;
    out += formatted(kLine, first ? row.id.c_str() : "", first ? row.scenario.c_str() : "",
                     d.by.c_str(), delay.c_str(), milliseconds_of(d.deadline).c_str(),
                     verdict.c_str());
    first = false;
  }
  if (row.detections.empty())
    out = formatted(kLine, row.id.c_str(), row.scenario.c_str(), "NONE", "-", "-", "");
  out += "       " + row.outcome + "\n";
  for (const std::string& failed : row.failed) out += "       FAILED: " + failed + "\n";
  return out;
}

}  // namespace

std::string id_of(const std::string& scenario) {
  std::string id = scenario.substr(0, 3);
  if (!id.empty()) id[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(id[0])));
  return std::ranges::find(kCatalogue, id, &CatalogueRow::id) == kCatalogue.end() ? "-" : id;
}

bool FaultRow::passed() const {
  return !detections.empty() && failed.empty() &&
         std::ranges::all_of(detections, &Detection::passed);
}

Result<FaultRow, Problem> run_fault(const bench::Loaded& loaded, world::MonitorSet off) {
  pipeline::Setup setup = loaded.setup;
  switch_off(setup.params, off);
  const auto result = bench::run_lockstep(loaded.scenario, setup, {});
  if (!result) return Unexpected{result.error()};
  FaultRow row{.id = id_of(loaded.scenario.name),
               .scenario = loaded.scenario.name,
               .detections = {},
               .outcome = bench::to_text(result->outcome),
               .failed = {},
               .simulated_s = result->simulated_s};
  for (const grading::Verdict& verdict : result->verdicts) {
    const auto asked = std::ranges::find(loaded.scenario.expect, verdict.name,
                                         &grading::Expectation::name);  // none: the contact
    if (asked != loaded.scenario.expect.end() && asked->kind == grading::Kind::kDetects)
      row.detections.push_back(detection(*asked, verdict));
    else if (!verdict.pass)
      row.failed.push_back(verdict.text + ": " + verdict.reason);
  }
  return row;
}

std::vector<std::string> holes(const std::vector<FaultRow>& rows) {
  std::vector<std::string> out;
  for (const CatalogueRow& wanted : kCatalogue) {
    const bool filled = std::ranges::any_of(
        rows, [&wanted](const FaultRow& row) { return row.id == wanted.id && row.passed(); });
    if (!filled) out.emplace_back(wanted.id);
  }
  return out;
}

std::string to_text(const std::vector<FaultRow>& rows) {
  std::string out =
      formatted("%-4s %-28s %-24s %6s %6s\n", "", "scenario", "detected by", "ms", "limit");
  for (const FaultRow& row : rows) out += lines_of(row);
  const std::vector<std::string> missing = holes(rows);
  const auto passed = std::ranges::count_if(rows, &FaultRow::passed);
  out += formatted("%zu of %zu scenarios passed; %zu of %zu faults covered\n",
                   static_cast<std::size_t>(passed), rows.size(),
                   kCatalogue.size() - missing.size(), kCatalogue.size());
  if (!missing.empty()) out += "not covered: " + list_of(missing) + "\n";
  return out;
}

std::string to_json(const std::vector<FaultRow>& rows, const std::vector<Proof>& proofs) {
  json::Array faults, monitors;
  for (const FaultRow& row : rows) faults.json(json_of(row));
  for (const Proof& proof : proofs) monitors.json(json_of(proof));
  return json::Object{}
             .json("faults", faults.str())
             .json("not_covered", json_list(holes(rows)))
             .json("proofs", monitors.str())
             .str() +
         "\n";
}

}  // namespace pitwall::fault_coverage
