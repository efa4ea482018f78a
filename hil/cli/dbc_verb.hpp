// `pitwall-hil dbc`: CAN databases of any team, checked, shown and compared before they meet a car.
//
//   check FILE... [--strict] [--json FILE]   every error, warning and note with its place
//   show FILE [MESSAGE|ID]                   tables of messages and signals; ID as 1303 or 0x517
//   diff ONE OTHER [--json FILE]             what changed, in words, worst first
//   out    exit code 0: clean, same; 1: check --strict found warnings, diff found differences;
//          2: a file was refused, or wrong usage
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int dbc_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
