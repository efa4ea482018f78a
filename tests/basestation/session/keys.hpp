// Key files of a car and its base in a new folder, for tests.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "basestation/link/key_pair.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::session {

// Writes both key files and returns the path of the base's file.
inline std::string made_keys(const transport::TemporaryFolder& folder, const std::string& name,
                             bool bench = false) {
  telemetry::SystemRandomness randomness;
  const std::string place = folder.path() + "/" + name;
  std::filesystem::create_directories(place);
  EXPECT_TRUE(link::write_key_pair(place, link::make_key_pair(randomness, bench)));
  return place + "/" + link::kBaseKeys;
}

}  // namespace pitwall::session
