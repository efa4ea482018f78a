// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "protocol/telemetry/session/traffic.hpp"
#include "tests/benchmarks/codec/peer.hpp"

namespace pitwall::codec {

using namespace telemetry;

namespace {

constexpr Instant kNow{100'000'000'000};

}  // namespace

Peer sealed(const Peer& plain, const std::string& name) {
  prepare_sodium();
  struct Session {
    Key key;
    Sealer sealer{key, 1, kNow};
    std::array<std::uint8_t, kMaxBody> body{}, opened{};
  };
  const auto session = std::make_shared<Session>();
  const auto encode = [session, plain](const Values& values, std::span<std::uint8_t> out) {
    const std::size_t body = plain.encode(values, session->body);
    const std::size_t size = kHeaderSize + body + kTagSize;
    session->sealer.seal(Kind::kSealed, 1, std::span(session->body).first(body), kNow,
                         out.first(size));
    return size;
  };
  // A receiver of its own for each, because it opens each packet once only.
  const auto decode = [session, plain](Bytes datagram, Values& values) {
    Opener opener(session->key, kNow);
    const auto header = parse_header(datagram);
    if (!header) return false;
    const auto opening = opener.open(*header, datagram, kNow, session->opened);
    if (opening.verdict != Opener::Verdict::kNew) return false;
    const std::size_t size = datagram.size() - kHeaderSize - kTagSize;
    return plain.decode(std::span(session->opened).first(size), values);
  };
  return {name, plain.bytes_by + ", sealed by us", plain.keeps, encode, decode};
}

}  // namespace pitwall::codec
