// Exit codes of pitwall-hil, and its error output.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

inline constexpr int kExitPass = 0;
inline constexpr int kExitFailed = 1;    // an expectation or a limit was not met
inline constexpr int kExitUnusable = 2;  // wrong usage, bad input, or the bench itself failed

inline constexpr int kExitContact = 4;  // the car hit a wall, and the scenario does not expect it

inline int refuse(const Problem& problem) {
  std::fprintf(stderr, "%s\n", to_string(problem).c_str());
  return kExitUnusable;
}

}  // namespace pitwall::cli
