// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/audit.hpp"

#include <utility>

namespace pitwall::command {

void Audit::add(Instant at, std::string who, std::string what, std::string result) {
  lines_.push_back({.number = ++count_,
                    .at = at,
                    .who = std::move(who),
                    .what = std::move(what),
                    .result = std::move(result)});
  if (lines_.size() > kKept) lines_.pop_front();
}

}  // namespace pitwall::command
