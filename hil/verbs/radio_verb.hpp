// pitwall-hil radio gates: the long form of what the radio promises, in virtual time.
//   in     --hours of link for budgets and ages (1 is the whole), --seed, --json FILE
//   out    a table with gate and figure; the same as JSON
//   errors exit 1 where a gate is missed, 2 for wrong usage
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::verbs {

int radio_verb(std::span<const std::string> args);

}  // namespace pitwall::verbs
