// `pitwall-hil dbc`: CAN databases of any team, checked, shown and compared before they meet a car.
//
//   check FILE... [--strict] [--all] [--json FILE]   every error, worst first, then warnings and
//                                                     notes in groups
//   show FILE [MESSAGE|ID]                tables of messages and signals; ID as 1303 or 0x517
//   diff ONE OTHER [--json FILE]          what changed, in words, worst first
//   in     files are read leniently: what is bad is left out or marked, and told
//   out    exit code 0: clean, same; 1: check --strict found warnings, diff found differences;
//          2: check found errors, a file is no database, or wrong usage
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int dbc_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
