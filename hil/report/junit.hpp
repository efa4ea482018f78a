// The verdicts of a run as JUnit XML, which every CI server reads: one test case per expectation.
//   in     RunData
//   out    one <testsuite>; a violated expectation is a <failure> with margin and time, what is
//          wrong with the bench or its log is an <error> in a case of its own
//   invariants
//          failures + errors == 0 exactly where the outcome is kPass
//   source the JUnit schema of Jenkins and Apache Ant
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/report/run_data.hpp"

namespace pitwall::report {

std::string junit_xml(const RunData& run);

}  // namespace pitwall::report
