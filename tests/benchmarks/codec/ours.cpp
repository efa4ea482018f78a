// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/packet/body.hpp"
#include "tests/benchmarks/codec/peer.hpp"

namespace pitwall::codec {
namespace {

using namespace telemetry;

constexpr Instant kNow{100'000'000'000};

std::span<const std::uint8_t> body_of(const Values& values, std::span<std::uint8_t> out) {
  static Snapshot snapshot = [] {
    Snapshot fresh;
    fresh.sampled_at.fill(kNow);
    return fresh;
  }();
  snapshot.values = values;
  BodyWriter writer(out, kMaxBody, Direction::kDown);
  writer.begin(kNow, 1);
  CodecCounters counters;
  writer.add_groups(snapshot, kVehicleStateGroups, kNow, counters);
  return writer.bytes();
}

}  // namespace

Peer ours() {
  return {.name = "ours",
          .bytes_by = "protocol/telemetry/packet",
          .keeps = Keeps::kSteps,
          .encode = [](const Values& values,
                       std::span<std::uint8_t> out) { return body_of(values, out).size(); },
          .decode =
              [](Bytes bytes, Values& values) {
                const auto body = parse_body(bytes, Direction::kDown);
                if (!body) return false;
                values = body->values;
                return true;
              }};
}

}  // namespace pitwall::codec
