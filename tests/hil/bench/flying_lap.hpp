// The flying lap of Las Vegas, loaded once per test program.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "hil/bench/loading.hpp"
#include "protocol/recording/mcap_writer.hpp"

namespace pitwall::bench {

inline const std::string kRoot = PITWALL_SOURCE_DIR;

// Sink of an event log that only its digest is wanted of.
inline recording::Sink nowhere() {
  return [](std::span<const std::uint8_t>) { return true; };
}

inline const Loaded& lap() {
  static const Loaded loaded = [] {
    auto read = load(kRoot + "/hil/scenarios/lvms_flying_lap.yaml", kRoot);
    if (!read) ADD_FAILURE() << to_string(read.error());
    return *std::move(read);
  }();
  return loaded;
}

}  // namespace pitwall::bench
