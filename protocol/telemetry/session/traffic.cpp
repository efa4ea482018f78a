// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/traffic.hpp"

#include <algorithm>
#include <string_view>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/sequence.hpp"

namespace pitwall::telemetry {

Key next_phase(const Key& key) {
  constexpr std::string_view kPurpose = "pitwall key phase";
  std::array<std::uint8_t, kPurpose.size()> purpose{};
  std::copy(kPurpose.begin(), kPurpose.end(), purpose.begin());
  return derive(key, purpose);
}

namespace {

constexpr bool bit_of(std::uint64_t phase) { return phase % 2 != 0; }

bool open_with(const Key& key, const Header& header, Bytes datagram, std::uint64_t number,
               std::span<std::uint8_t> plain) {
  const std::size_t body = datagram.size() - kHeaderSize - kTagSize;
  if (header.kind == Kind::kSealed) {
    return aead_open(key, number, datagram.first(kHeaderSize), datagram.subspan(kHeaderSize),
                     plain.first(body));
  }
  const Bytes readable = datagram.first(kHeaderSize + body);
  if (!aead_open(key, number, readable, datagram.subspan(readable.size()), plain.first(0))) {
    return false;
  }
  std::copy_n(datagram.begin() + kHeaderSize, body, plain.begin());
  return true;
}

}  // namespace

Sealer::Sealer(const Key& key, std::uint64_t first, Instant now, const PhaseLimits& limits)
    : key_(key), limits_(limits), next_(first), phase_first_(first), phase_since_(now) {
  CHECK(first > 0);
}

std::uint64_t Sealer::seal(Kind kind, std::uint16_t receiver, Bytes body, Instant now,
                           std::span<std::uint8_t> out) {
  CHECK(kind == Kind::kSealed || kind == Kind::kSigned);
  CHECK(out.size() == kHeaderSize + body.size() + kTagSize);
  if (next_ - phase_first_ >= limits_.packets || now - phase_since_ >= limits_.time) advance(now);
  const std::uint64_t number = next_++;
  write_header({.kind = kind,
                .key_phase = bit_of(phase_),
                .receiver = receiver,
                .sequence_low = static_cast<std::uint32_t>(number)},
               out);
  if (kind == Kind::kSealed) {
    aead_seal(key_, number, out.first(kHeaderSize), body, out.subspan(kHeaderSize));
  } else {
    std::copy(body.begin(), body.end(), out.begin() + kHeaderSize);
    const auto readable = out.first(kHeaderSize + body.size());
    aead_seal(key_, number, readable, {}, out.subspan(readable.size()));
  }
  return number;
}

void Sealer::advance(Instant now) {
  key_ = next_phase(key_);
  ++phase_;
  phase_first_ = next_;
  phase_since_ = now;
}

Opener::Opener(const Key& key, Instant now, const ReplayWindow& window)
    : key_(key), received_(now), window_(window) {}

Opener::Opening Opener::open(const Header& header, Bytes datagram, Instant now,
                             std::span<std::uint8_t> plain) {
  const std::uint64_t number = whole_number(header.sequence_low, window_.newest());
  if (window_.too_old(number)) return {.verdict = Verdict::kTooOld};
  if (!opens(header, datagram, number, now, plain)) return {.verdict = Verdict::kForged};
  if (window_.had(number)) return {.verdict = Verdict::kDuplicate, .number = number};
  const bool newest = number > window_.newest();
  window_.set(number);
  received_ = now;
  return {.verdict = Verdict::kNew, .number = number, .newest = newest};
}

bool Opener::opens(const Header& header, Bytes datagram, std::uint64_t number, Instant now,
                   std::span<std::uint8_t> plain) {
  const bool this_phase = header.key_phase == bit_of(phase_);
  if (!this_phase && number < phase_first_) {
    return previous_ && now < previous_until_ &&
           open_with(*previous_, header, datagram, number, plain);
  }
  if (this_phase && open_with(key_, header, datagram, number, plain)) return true;
  return opens_in_later_phase(header, datagram, number, now, plain);
}

bool Opener::opens_in_later_phase(const Header& header, Bytes datagram, std::uint64_t number,
                                  Instant now, std::span<std::uint8_t> plain) {
  const std::int64_t allowed =
      std::clamp<std::int64_t>((now - received_) / kPhaseTime + 1, 1, kMaxSilentPhases);
  if (allowed == 1 && header.key_phase == bit_of(phase_)) return false;
  Key before = key_;
  for (std::int64_t ahead = 1; ahead <= allowed; ++ahead) {
    const Key key = next_phase(before);
    const std::uint64_t phase = phase_ + static_cast<std::uint64_t>(ahead);
    if (bit_of(phase) == header.key_phase && open_with(key, header, datagram, number, plain)) {
      previous_ = before;
      key_ = key;
      phase_ = phase;
      phase_first_ = number;
      previous_until_ = now + kOldPhaseKept;
      return true;
    }
    before = key;
  }
  return false;
}

}  // namespace pitwall::telemetry
