// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/offered_load.hpp"

#include <algorithm>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::radio {

namespace {

constexpr Duration kEvery = milliseconds(50);

}  // namespace

OfferedLoad::OfferedLoad(double rate_bytes_per_s, double multiple)
    : object_(std::min(static_cast<std::size_t>(rate_bytes_per_s * multiple * kEvery.seconds()),
                       telemetry::kBulkObject)) {}

void OfferedLoad::run(VirtualRadio& radio, Duration length) {
  for (const Instant end = radio.now() + length; radio.now() < end; radio.step()) {
    if (object_.empty() || (radio.now() - Instant{}).ns % kEvery.ns != 0) continue;
    object_[0] = static_cast<std::uint8_t>(object_[0] + 1);
    CHECK(radio.car().offer(telemetry::BulkKind::kPoints, object_));
  }
}

}  // namespace pitwall::radio
