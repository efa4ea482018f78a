// Subcommand `pitwall-hil falsify PLAN`: looks for values at which the scenario of a plan misses an
// expectation (falsifier.hpp), guided by the margins.
//
//   --runs N       at most; default 200
//   --processes N  threads; default: the processors
//   --out FILE     the scenario that missed one; default out/falsified/NAME.yaml
//   out    exit code 0 nothing found, 1 found, 2 bad input
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int falsify_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
