// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/session/traffic.hpp"
#include "tests/benchmarks/codec/contestant.hpp"

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

Contestant ours() {
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

// The whole datagram: header, encrypted body, tag. The acknowledgement is not in every packet.
Contestant ours_sealed() {
  prepare_sodium();
  struct Session {
    Key key;
    Sealer sealer{key, 1, kNow};
    std::array<std::uint8_t, kMaxBody> body{}, plain{};
  };
  const auto session = std::make_shared<Session>();
  const auto encode = [session](const Values& values, std::span<std::uint8_t> out) {
    const auto body = body_of(values, session->body);
    const std::size_t size = kHeaderSize + body.size() + kTagSize;
    session->sealer.seal(Kind::kSealed, 1, body, kNow, out.first(size));
    return size;
  };
  // A receiver of its own for each, because it opens each packet once only.
  const auto decode = [session](Bytes datagram, Values& values) {
    Opener opener(session->key, kNow);
    const auto header = parse_header(datagram);
    if (!header) return false;
    const auto opening = opener.open(*header, datagram, kNow, session->plain);
    if (opening.verdict != Opener::Verdict::kNew) return false;
    const std::size_t size = datagram.size() - kHeaderSize - kTagSize;
    const auto body = parse_body(std::span(session->plain).first(size), Direction::kDown);
    if (!body) return false;
    values = body->values;
    return true;
  };
  return {"ours, sealed", "protocol/telemetry/packet and session", Keeps::kSteps, encode, decode};
}

}  // namespace pitwall::codec
