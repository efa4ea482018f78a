// Key log of a session as lines of text, with which Wireshark decrypts recordings of a bench: one
// line CHACHA20_POLY1305 RECEIVER PHASE KEY for each phase that kMaxSilentPhases allows. Receiver
// (as in the header) and key are hexadecimal, the phase is decimal.
//   invariants
//          only keys of bench runs are logged (KeyFile::bench); they decrypt nothing else
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "protocol/telemetry/session/crypto/cipher.hpp"

namespace pitwall::telemetry {

// Receives the lines of each session, for both directions.
using KeyLog = std::function<void(const std::string& lines)>;

// Lines for the packets with this receiver number; `first` is the key of phase 0.
std::string key_log_lines(std::uint16_t receiver, const Key& first);

}  // namespace pitwall::telemetry
