// New keys for one car and its base, as two files of a folder.
//   out    FOLDER/car.keys and FOLDER/base.keys, for their owner only
//   errors Problem with the path: one of them exists (nothing is written then), or the disk refuses
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/telemetry/session/keys.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::intake {

inline constexpr const char *kCarKeys = "car.keys", *kBaseKeys = "base.keys";

struct KeyPair {
  telemetry::KeyFile car, base;
};
KeyPair make_key_pair(telemetry::Randomness& randomness);

Result<bool, Problem> write_key_pair(const std::string& folder, const KeyPair& pair);
// A file of that role.
Result<telemetry::KeyFile, Problem> read_keys(const std::string& path, telemetry::Role role);

}  // namespace pitwall::intake
