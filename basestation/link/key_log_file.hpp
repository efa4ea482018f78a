// Key log file of a base on the bench, for Wireshark.
//   in     path, readable by its owner only; the keys of the base
//   out    a function that appends the lines of each session to the file
//   errors Problem with the option for keys that are not bench keys; Problem with the path for a
//          file that is not private to this user
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/telemetry/session/crypto/keys.hpp"
#include "protocol/telemetry/session/key_log.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::link {

Result<telemetry::KeyLog, Problem> key_log_to(const std::string& path,
                                              const telemetry::KeyFile& keys);

}  // namespace pitwall::link
