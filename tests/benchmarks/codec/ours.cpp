// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <numeric>

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
std::optional<Measured> ours_sealed(const std::vector<Values>& trace) {
  prepare_sodium();
  Key key;
  std::array<std::uint8_t, kMaxBody> body{}, plain{};
  std::array<std::uint8_t, kMaxDatagram> datagram{};
  Sealer sealer(key, 1, kNow);
  Opener opener(key, kNow);
  double bytes = 0.0, seal_ns = 0.0, open_ns = 0.0;
  for (const Values& values : trace) {
    using Clock = std::chrono::steady_clock;
    const auto begun = Clock::now();
    const auto content = body_of(values, body);
    sealer.seal(Kind::kSealed, 1, content, kNow,
                {datagram.data(), content.size() + kHeaderSize + kTagSize});
    const auto sealed = Clock::now();
    const std::size_t size = content.size() + kHeaderSize + kTagSize;
    const auto header = parse_header({datagram.data(), size});
    if (!header) return std::nullopt;
    const auto opening = opener.open(*header, {datagram.data(), size}, kNow, plain);
    const auto read = parse_body({plain.data(), content.size()}, Direction::kDown);
    const auto opened = Clock::now();
    if (opening.verdict != Opener::Verdict::kNew || !read) return std::nullopt;
    bytes += static_cast<double>(size);
    seal_ns += std::chrono::duration<double, std::nano>(sealed - begun).count();
    open_ns += std::chrono::duration<double, std::nano>(opened - sealed).count();
  }
  const auto count = static_cast<double>(trace.size());
  return Measured{.name = "ours, sealed",
                  .bytes_by = "protocol/telemetry/packet and session",
                  .payload = static_cast<double>(bytes_of(kVehicleStateSet)),
                  .datagram = bytes / count,
                  .authenticated = true,
                  .encode_ns = seal_ns / count,
                  .decode_ns = open_ns / count};
}

}  // namespace pitwall::codec
