// A scenario of this repository, loaded.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "hil/bench/loading.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::cli {

inline bench::Loaded shipped(const std::string& scenario) {
  const std::string root = PITWALL_SOURCE_DIR;
  auto read = bench::load(root + "/hil/scenarios/" + scenario + ".yaml", root);
  if (!read) ADD_FAILURE() << to_string(read.error());
  CHECK(read);
  return *std::move(read);
}

}  // namespace pitwall::cli
