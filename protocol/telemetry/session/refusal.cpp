// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/refusal.hpp"

#include <array>

namespace pitwall::telemetry {

const char* text_of(Refusal refusal) {
  constexpr std::array<const char*, kRefusals> kTexts{
      "not a datagram of this protocol",
      "of a session that is not ours",
      "had before or too old",
      "forged",
      "key exchange with another key",
      "answers no key exchange under way",
      "key exchange with an old stamp",
      "sealed where signed was agreed, or the other way",
      "about a session that is not in use"};
  return kTexts[static_cast<std::size_t>(refusal)];
}

}  // namespace pitwall::telemetry
