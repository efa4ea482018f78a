// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/path_receipts.hpp"

#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::telemetry {
namespace {

constexpr Duration kTick = microseconds(100);

}  // namespace

void PathReceipts::sent(std::uint64_t sequence, std::uint8_t paths, std::size_t bytes, Instant at) {
  sent_[sequence % sent_.size()] = {sequence, at, bytes, paths};
}

void PathReceipts::write(BodyWriter& body, std::span<PathLane> lanes, Instant now) {
  std::uint8_t path = 0;
  for (PathLane& lane : lanes) {
    const std::int64_t hold = (now - lane.received_at) / kTick;
    const bool news = lane.newest != lane.reported && hold >= 0 && hold <= UINT16_MAX;
    std::array<std::uint8_t, kSize> bytes{path++};
    if (!news) continue;
    store<std::uint16_t>(bytes, 1, static_cast<std::uint16_t>(lane.newest));
    store<std::uint16_t>(bytes, 3, static_cast<std::uint16_t>(hold));
    if (body.add_record(RecordType::kPathReceipt, bytes)) lane.reported = lane.newest;
  }
}

bool PathReceipts::take(std::span<const std::uint8_t> payload, std::span<PathLane> lanes,
                        Instant peer_sent, Instant at) const {
  if (payload.size() != kSize || payload[0] >= lanes.size()) return false;
  const auto low = load<std::uint16_t>(payload, 1);
  const Sent& sent = sent_[low % sent_.size()];
  const bool known = static_cast<std::uint16_t>(sent.sequence) == low && sent.sequence != 0;
  if (!known || (sent.paths >> payload[0] & 1U) == 0) return false;
  const Duration hold = kTick * load<std::uint16_t>(payload, 3);
  lanes[payload[0]].rate.delivered(sent.at, peer_sent - hold, sent.bytes, at);
  return true;
}

}  // namespace pitwall::telemetry
