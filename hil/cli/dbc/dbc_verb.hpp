// Subcommand `pitwall-hil dbc`: checks, shows and compares CAN databases before they are used in a
// car.
//
//   check FILE... [--strict] [--all] [--json FILE]   every error, worst first, then warnings and
//                                                     notes in groups
//   show FILE [MESSAGE|ID]                tables of messages and signals; ID as 1303 or 0x517
//   diff ONE OTHER [--json FILE]          the changes as text, worst first
//   in     files are read leniently: bad entries are left out or marked, and reported
//   out    exit code 0: no errors, no differences; 1: check --strict found warnings, diff found
//          differences; 2: check found errors, a file is not a database, or wrong usage
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int dbc_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
