// SPDX-License-Identifier: Apache-2.0
#include "basestation/intake/state_intake.hpp"

namespace pitwall::intake {

std::optional<telemetry::StatePacket> StateIntake::feed(std::span<const std::uint8_t> datagram,
                                                        Instant at) {
  ++counters_.received;
  auto parsed = telemetry::parse(datagram);
  if (!parsed) {
    ++counters_.refused[static_cast<std::size_t>(parsed.error())];
    return std::nullopt;
  }
  if (!belongs_to_run(*parsed, at)) {
    ++counters_.other_run;
    return std::nullopt;
  }
  if (!advances(parsed->sequence)) return std::nullopt;
  runs_.accepted(at);
  ++counters_.accepted;
  return *parsed;
}

bool StateIntake::belongs_to_run(const telemetry::StatePacket& packet, Instant at) {
  const auto verdict = runs_.judge(packet.run, at);
  if (verdict != telemetry::RunFilter::Verdict::kBegun)
    return verdict == telemetry::RunFilter::Verdict::kSame;
  newest_ = packet.sequence - 1;  // what was sent before the first that we hear is not lost
  seen_ = ~std::uint64_t{0};
  ++counters_.runs;
  return true;
}

bool StateIntake::advances(std::uint32_t sequence) {
  // Modulo 2^32: half of the circle is ahead.
  const auto ahead = static_cast<std::int32_t>(sequence - newest_);
  if (ahead > 0) {
    const auto steps = static_cast<std::uint32_t>(ahead);
    counters_.lost += steps - 1;
    seen_ = steps < kWindow ? (seen_ << steps) | 1U : 1U;
    newest_ = sequence;
    return true;
  }
  const std::uint32_t behind = newest_ - sequence;
  const std::uint64_t bit = behind < kWindow ? std::uint64_t{1} << behind : 0;
  if ((seen_ & bit) != 0) {
    ++counters_.duplicates;
    return false;
  }
  ++counters_.late;
  if (bit != 0) {  // further back nobody knows whether it was counted
    seen_ |= bit;
    --counters_.lost;
  }
  return false;
}

}  // namespace pitwall::intake
