// New keys for one car and its base, as two files of a folder.
//   in     whether they are for the bench: then sessions may be logged, and no real car takes them
//   out    FOLDER/car.keys and FOLDER/base.keys, for their owner only; a new folder likewise
//   errors Problem with the path: one of them exists or others may write the folder (nothing is
//          written then), or the disk refuses
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
// A file of that role.
Result<telemetry::KeyFile, Problem> read_keys(const std::string& path, telemetry::Role role);

}  // namespace pitwall::link
