// SPDX-License-Identifier: Apache-2.0
#include "hil/matrix/fault_matrix.hpp"

#include <algorithm>
#include <cctype>

#include "hil/bench/lockstep.hpp"
#include "hil/matrix/catalogue.hpp"
#include "hil/matrix/text.hpp"
#include "protocol/json/json_text.hpp"
#include "vehicle/pipeline/monitoring.hpp"

namespace pitwall::matrix {
namespace {

constexpr std::string_view kSeen = "seen_";

Detection detection(const scenario::Expectation& asked, const grading::Verdict& verdict) {
  const bool monitor = asked.signal.starts_with(kSeen);
  return {.by = monitor ? asked.signal.substr(kSeen.size())
                        : asked.signal + " " + asked.relation + " " + format("%g", asked.value),
          .delay = verdict.delay,
          .deadline = asked.until - asked.from,
          .passed = verdict.pass,
          .reason = verdict.reason};
}

std::string milliseconds_of(Duration d) { return format("%.0f", d.milliseconds()); }

std::string json_of(const Detection& d) {
  return "{\"by\":" + json::quoted(d.by) +
         ",\"delay_s\":" + (d.delay ? format("%.3f", d.delay->seconds()) : "null") +
         ",\"deadline_s\":" + format("%.3f", d.deadline.seconds()) +
         ",\"passed\":" + (d.passed ? "true" : "false") + "}";
}

std::string json_of(const FaultRow& row) {
  std::string detections;
  for (const Detection& d : row.detections)
    detections += (detections.empty() ? "" : ",") + json_of(d);
  return "{\"id\":" + json::quoted(row.id) + ",\"scenario\":" + json::quoted(row.scenario) +
         ",\"passed\":" + (row.passed() ? "true" : "false") + ",\"detections\":[" + detections +
         "],\"outcome\":" + json::quoted(row.outcome) + ",\"failed\":" + json_list(row.failed) +
         "}";
}

std::string lines_of(const FaultRow& row) {
  constexpr const char* kLine = "%-4s %-28s %-24s %6s %6s  %s\n";
  std::string out;
  bool first = true;
  for (const Detection& d : row.detections) {
    const std::string delay = d.delay ? milliseconds_of(*d.delay) : std::string("-");
    const std::string verdict = d.passed ? "" : "MISSED: " + d.reason;
    out +=
        format(kLine, first ? row.id.c_str() : "", first ? row.scenario.c_str() : "", d.by.c_str(),
               delay.c_str(), milliseconds_of(d.deadline).c_str(), verdict.c_str());
    first = false;
  }
  if (row.detections.empty())
    out = format(kLine, row.id.c_str(), row.scenario.c_str(), "NOBODY", "-", "-", "");
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
  pipeline::switch_off(setup.params, off);
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
                                         &scenario::Expectation::place);  // none: the contact
    if (asked != loaded.scenario.expect.end() && asked->kind == scenario::ExpectKind::kDetects)
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
      format("%-4s %-28s %-24s %6s %6s\n", "", "scenario", "detected by", "ms", "limit");
  for (const FaultRow& row : rows) out += lines_of(row);
  const std::vector<std::string> missing = holes(rows);
  const auto passed = std::ranges::count_if(rows, &FaultRow::passed);
  out += format("%zu of %zu scenarios passed; %zu of %zu faults covered\n",
                static_cast<std::size_t>(passed), rows.size(), kCatalogue.size() - missing.size(),
                kCatalogue.size());
  if (!missing.empty()) out += "not covered: " + list_of(missing) + "\n";
  return out;
}

std::string to_json(const std::vector<FaultRow>& rows, const std::vector<Proof>& proofs) {
  std::string faults, monitors;
  for (const FaultRow& row : rows) faults += (faults.empty() ? "" : ",\n") + json_of(row);
  for (const Proof& proof : proofs) monitors += (monitors.empty() ? "" : ",\n") + json_of(proof);
  return "{\"faults\":[" + faults + "],\n\"not_covered\":" + json_list(holes(rows)) +
         ",\n\"proofs\":[" + monitors + "]}\n";
}

}  // namespace pitwall::matrix
