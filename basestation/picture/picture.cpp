// SPDX-License-Identifier: Apache-2.0
#include "basestation/picture/picture.hpp"

#include <cmath>

namespace pitwall::picture {

const char* text_of(Quality quality) {
  switch (quality) {
    case Quality::kFresh:
      return "fresh";
    case Quality::kLate:
      return "late";
    case Quality::kStale:
      return "stale";
    case Quality::kNever:
      return "never";
  }
  return "?";
}

void Picture::update(const telemetry::StatePacket& packet, Instant received) {
  ever_ = true;
  source_ = packet.source;
  for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i) {
    const double value = packet.values[i];
    const Duration age = packet.age_of(telemetry::kFields[i].group);
    if (std::isnan(value) || age.ns < 0) continue;
    latest_[i] = {.value = value, .received = received, .age_when_sent = age, .ever = true};
  }
}

FieldView Picture::view(telemetry::FieldIndex field, Instant now) const {
  const Latest& latest = latest_[field];
  if (!latest.ever) return {};
  const Duration age = latest.age_when_sent + (now - latest.received);
  const Duration target = telemetry::kFields[field].target_age();
  const Quality quality = age <= target                 ? Quality::kFresh
                          : age <= kLateFactor * target ? Quality::kLate
                                                        : Quality::kStale;
  return {.value = latest.value, .age = age, .quality = quality};
}

}  // namespace pitwall::picture
