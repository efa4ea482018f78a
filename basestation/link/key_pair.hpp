// New keys for one car and its base, as two files in a folder.
//   in     whether the keys are for the bench: then sessions may be logged, and no real car accepts
//          them
//   out    FOLDER/car.keys and FOLDER/base.keys, readable by their owner only; so is a new folder
//   errors Problem with the path: one of the files exists, other users may write to the folder (in
//          both cases nothing is written), or the disk refuses
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/telemetry/session/crypto/keys.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::link {

inline constexpr const char *kCarKeys = "car.keys", *kBaseKeys = "base.keys";

struct KeyPair {
  telemetry::KeyFile car, base;
};
KeyPair make_key_pair(telemetry::Randomness& randomness, bool bench = false);

Result<bool, Problem> write_key_pair(const std::string& folder, const KeyPair& pair);
// Reads a key file of this role.
Result<telemetry::KeyFile, Problem> read_keys(const std::string& path, telemetry::Role role);

}  // namespace pitwall::link
