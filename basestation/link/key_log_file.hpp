// Key log file of a base on the bench, for Wireshark.
//   in     path, readable by its owner only; the keys that the base was given
//   out    what appends each session's lines to it
//   errors Problem with the option: keys that are not for the bench; with a file that is not ours
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
