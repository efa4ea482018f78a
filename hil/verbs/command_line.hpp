// The words of a verb, read by its CLI11 app.
//   in     the app with its options, the words after the verb
//   out    nothing where the verb shall go on; else the exit code with which it is over: help was
//          asked for and given, or the words are wrong and it has been said why
//   errors the exit code
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hil/verbs/exit_code.hpp"

namespace pitwall::verbs {

inline std::optional<int> ended_by(CLI::App& app, std::span<const std::string> args) {
  try {
    std::vector<std::string> reversed(args.rbegin(), args.rend());  // as CLI11 wants them
    app.parse(reversed);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitPass : kExitUnusable;
  }
  return std::nullopt;
}

}  // namespace pitwall::verbs
