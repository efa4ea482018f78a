// The keys of a session as lines of text, with which Wireshark opens what a bench recorded: one for
// each phase that kMaxPhasesUnheard allows, CHACHA20_POLY1305 RECEIVER PHASE KEY; receiver as in
// the header and key in hexadecimal, phase in decimal.
//   invariants
//          only the keys of a run of the bench are ever told (KeyFile::bench): they open nothing
//          else
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "protocol/telemetry/session/crypto/cipher.hpp"

namespace pitwall::telemetry {

// Hears the lines of each session, both directions.
using KeyLog = std::function<void(const std::string& lines)>;

// Of the packets that carry this receiver's number; `first` is the key of phase 0.
std::string key_log_lines(std::uint16_t receiver, const Key& first);

}  // namespace pitwall::telemetry
