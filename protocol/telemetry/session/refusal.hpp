// Reason why a datagram is refused. Refusals are counted; no reply is longer than the datagram.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace pitwall::telemetry {

enum class Refusal : std::uint8_t {
  kHeader,       // HeaderError, or too short for its kind
  kNoSession,    // number of an unknown session
  kReplayed,     // received before, or older than the window
  kForged,       // the tag is wrong
  kBadExchange,  // an opening or answer that is not by the provisioned key, or for the other role
  kOldExchange,  // a message of an exchange that is not under way
  kOldStamp,     // an opening whose stamp is not newer than one received before: a replay
  kWrongMode,    // sealed while this end is set to signed, or the reverse
  kForeignBoot   // a hint for another session, too early, or forged
};
inline constexpr std::size_t kRefusals = 9;
const char* text_of(Refusal refusal);

}  // namespace pitwall::telemetry
