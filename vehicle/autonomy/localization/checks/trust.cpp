// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/trust.hpp"

#include <algorithm>
#include <limits>

namespace pitwall::localization {

void Trust::receive(double silence_s, Instant now) {
  if (received && now - received_at > from_seconds(silence_s)) {
    trusted = false;
    consistent = false;
  }
  received = true;
  received_at = now;
}

void Trust::refuse(const CheckParams& params) {
  consistent = false;
  constexpr int kMost = std::numeric_limits<std::uint8_t>::max();
  refused_in_row = static_cast<std::uint8_t>(std::min<int>(refused_in_row + 1, kMost));
  if (refused_in_row >= params.distrust_samples) trusted = false;
}

bool Trust::admit(const CheckParams& params, bool alone, Instant now) {
  refused_in_row = 0;
  if (!consistent) consistent_since = now;
  consistent = true;
  const double after_s = alone ? params.readmit_alone_after_s : params.readmit_after_s;
  if (now - consistent_since >= from_seconds(after_s)) trusted = true;
  return trusted;
}

}  // namespace pitwall::localization
