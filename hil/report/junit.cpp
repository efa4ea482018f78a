// SPDX-License-Identifier: Apache-2.0
#include "hil/report/junit.hpp"

#include <algorithm>
#include <cmath>

#include "hil/report/text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

std::string test_case(const std::string& suite, const std::string& name,
                      const std::string& inside) {
  return "  <testcase classname=\"" + suite + "\" name=\"" + escaped(name) + "\" time=\"0\"" +
         (inside.empty() ? "/>\n" : ">\n    " + inside + "\n  </testcase>\n");
}

std::string failure_of(const VerdictRow& v) {
  if (v.pass) return {};
  std::string words = v.reason.empty() ? "violated" : v.reason;
  if (std::isfinite(v.first_violation_s))
    words += "; first violated at " + number(v.first_violation_s, 3) + " s";
  if (std::isfinite(v.margin)) words += "; margin " + significant(v.margin, 6);
  return "<failure message=\"" + escaped(words) + "\">" +
         escaped(words + (v.place.empty() ? "" : "; " + v.place)) + "</failure>";
}

}  // namespace

std::string junit_xml(const RunData& run) {
  const auto failures = std::ranges::count_if(run.verdicts, [](const auto& v) { return !v.pass; });
  const std::string name = run.facts.scenario.empty() ? "run without a name" : run.facts.scenario;
  const std::string suite = "pitwall." + escaped(name) + "." + escaped(run.facts.mode);
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"" + suite + "\"" +
      formatted(" tests=\"%zu\" failures=\"%td\" errors=\"%zu\" skipped=\"0\" time=\"",
                run.verdicts.size() + run.infrastructure.size(), failures,
                run.infrastructure.size()) +
      number(run.end_s(), 3) + "\">\n";
  out += "  <properties><property name=\"seed\" value=\"" + escaped(run.facts.seed) +
         "\"/><property name=\"event_log_sha256\" value=\"" + escaped(run.digest) +
         "\"/><property name=\"simulation\" value=\"true\"/></properties>\n";
  for (const VerdictRow& verdict : run.verdicts)
    out += test_case(suite, verdict.text, failure_of(verdict));
  for (std::size_t i = 0; i < run.infrastructure.size(); ++i)
    out += test_case(suite, "bench " + std::to_string(i + 1),
                     "<error message=\"" + escaped(run.infrastructure[i]) + "\">" +
                         escaped(run.infrastructure[i]) + "</error>");
  return out + "</testsuite>\n";
}

}  // namespace pitwall::report
