// Keys of a car and its base in a folder of their own.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "basestation/intake/key_pair.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::stand {

// The path of the base's.
inline std::string made_keys(const transport::TemporaryFolder& folder, const std::string& name,
                             bool bench = false) {
  telemetry::SystemRandomness randomness;
  const std::string place = folder.path() + "/" + name;
  std::filesystem::create_directories(place);
  EXPECT_TRUE(intake::write_key_pair(place, intake::make_key_pair(randomness, bench)));
  return place + "/" + intake::kBaseKeys;
}

}  // namespace pitwall::stand
