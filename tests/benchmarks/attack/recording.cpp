// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/attack/recording.hpp"

#include <algorithm>

#include "protocol/telemetry/packet/header.hpp"

namespace pitwall::attack {

void Recording::add(const Copy& copy) {
  const Bytes bytes(copy.bytes.begin(), copy.bytes.end());
  const auto header = telemetry::parse_header(bytes);
  const bool opening = header && header->kind == telemetry::Kind::kOpening;
  if (opening && openings_.size() < kMost && known_.insert(bytes).second)
    openings_.push_back(bytes);
  if (capture_.size() < kMost) capture_.push_back({copy.from_car, bytes});
}

std::span<const Bytes> Recording::openings(std::size_t count) const {
  return std::span(openings_).last(std::min(count, openings_.size()));
}

}  // namespace pitwall::attack
