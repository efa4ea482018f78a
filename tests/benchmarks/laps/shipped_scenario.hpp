// Loader of a shipped scenario with all files that it names.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "hil/bench/loading.hpp"

namespace pitwall::laps {

inline bench::Loaded shipped_scenario(const std::string& name) {
  const std::string root = PITWALL_SOURCE_DIR;
  auto read = bench::load(root + "/hil/scenarios/" + name + ".yaml", root);
  if (!read) ADD_FAILURE() << to_string(read.error());
  return *std::move(read);
}

}  // namespace pitwall::laps
