// JUnit XML of the verdicts of a run, for CI servers: one test case per expectation.
//   in     RunData
//   out    one <testsuite>; a violated expectation is a <failure> with margin and time; each fault
//          of the bench or its log is an <error> in a test case of its own
//   invariants
//          failures + errors == 0 exactly if the outcome is kPass
//   source the JUnit schema of Jenkins and Apache Ant
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/report/run_data.hpp"

namespace pitwall::report {

std::string junit_xml(const RunData& run);

}  // namespace pitwall::report
