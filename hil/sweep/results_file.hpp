// Results of a sweep as an SQLite file, for any tool that reads SQL.
//   tables plan(name, scenario, text); parameter(id, path); expectation(id, text);
//          run(number, verdict, why, digest, simulated_s); setting(run, path, value);
//          margin(run, expectation, margin, pass), NULL where a margin is not finite
//   law    the same results give the same bytes, whatever process made them and in which order
//   errors Problem with the file and SQLite's reason, or the schema; the file that was there stays
//   cost   linear in the number of results, 30 us each
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "hil/sweep/case_result.hpp"
#include "hil/sweep/cases.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::sweep {

inline constexpr int kResultsSchema = 1;  // PRAGMA user_version

// Refuses a file of another schema, or one that is no database; one that is not there is good.
Result<bool, Problem> check_results(const std::string& file);

// `results`: in the order of their numbers.
Result<bool, Problem> write_results(const std::string& file, const Cases& cases,
                                    const std::string& plan_text,
                                    std::span<const CaseResult> results);

}  // namespace pitwall::sweep
