// Why a datagram had no effect. Each is counted; none of them is answered with more than came.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace pitwall::telemetry {

enum class Refusal : std::uint8_t {
  kHeader,         // HeaderError, or too short for its kind
  kNoSession,      // number of a session that is not ours
  kReplayed,       // had before, or older than the window
  kForged,         // the tag does not fit
  kBadExchange,    // an opening or answer that is not of the provisioned key
  kOldExchange,    // answers an opening that is not under way
  kOldStamp,       // an opening whose stamp is not newer than one had before: a replay
  kTooManyKnocks,  // beyond what is even answered
  kWrongMode,      // sealed where signed was agreed, or the other way
  kForeignBoot     // hints and the like that do not concern us
};
inline constexpr std::size_t kRefusals = 10;
const char* text_of(Refusal refusal);

}  // namespace pitwall::telemetry
