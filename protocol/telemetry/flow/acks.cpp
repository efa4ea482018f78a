// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/acks.hpp"

#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr Duration kMostHold = microseconds(100) * 0xFFFF;  // as the wire has it; saturated there
constexpr unsigned kMaskBits = 32;

}  // namespace

void ReceivedPackets::received(std::uint64_t sequence, Instant at) {
  CHECK(sequence > 0);
  if (sequence > newest_) {
    const std::uint64_t step = sequence - newest_;
    mask_ = step < kMaskBits ? mask_ << step : 0;
    if (newest_ > 0 && step <= kMaskBits) mask_ |= std::uint32_t{1} << (step - 1);
    newest_ = sequence;
    newest_at_ = at;
  } else if (const std::uint64_t behind = newest_ - sequence; behind >= 1 && behind <= kMaskBits) {
    mask_ |= std::uint32_t{1} << (behind - 1);
  }
}

std::optional<Ack> ReceivedPackets::ack(Instant now) const {
  if (newest_ == 0) return std::nullopt;
  return Ack{static_cast<std::uint16_t>(newest_), mask_, now - newest_at_};
}

void SentPackets::sent(std::uint64_t sequence, Instant at, std::size_t bytes) {
  CHECK(sequence > newest_);
  if (newest_ == 0) oldest_ = sequence;
  newest_ = sequence;
  kept_[sequence % kKept] = {{sequence, at, bytes}, false};
}

void SentPackets::forget() {
  const std::uint64_t nonsense = nonsense_;
  *this = {};
  nonsense_ = nonsense;
}

const SentPackets::Entry* SentPackets::find(std::uint64_t sequence) const {
  const Entry& entry = kept_[sequence % kKept];
  return sequence > 0 && entry.delivery.sequence == sequence ? &entry : nullptr;
}

bool SentPackets::makes_sense(std::uint64_t newest, std::uint32_t mask) const {
  if (newest < oldest_ || newest > newest_) return false;
  for (unsigned bit = 0; bit < kMaskBits; ++bit) {
    if ((mask >> bit & 1U) == 0) continue;
    const std::uint64_t behind = std::uint64_t{bit} + 1;
    if (newest < oldest_ + behind) return false;
    const std::uint64_t named = newest - behind;
    if (newest_ - named < kKept && find(named) == nullptr) return false;
  }
  return true;
}

void SentPackets::note(std::uint64_t sequence, News& news) {
  Entry& entry = kept_[sequence % kKept];
  if (entry.delivery.sequence != sequence || entry.acked) return;
  entry.acked = true;
  CHECK(news.delivered.push(entry.delivery));
}

SentPackets::News SentPackets::take(const Ack& ack) {
  News news;
  // The 64-bit number not above the newest sent whose low half is named.
  const auto behind =
      static_cast<std::uint16_t>(static_cast<std::uint16_t>(newest_) - ack.newest_low);
  const std::uint64_t named = newest_ - behind;
  if (newest_ == 0 || behind > newest_ || !makes_sense(named, ack.mask)) {
    ++nonsense_;
    return news;
  }
  const Entry* newest = find(named);
  if (newest == nullptr) {
    if (newest_ - named < kKept) ++nonsense_;
    return news;
  }
  if (ack.hold < kMostHold) news.newest = newest->delivery;
  for (unsigned bit = kMaskBits; bit-- > 0;) {
    if ((ack.mask >> bit & 1U) != 0) note(named - bit - 1, news);
  }
  note(named, news);
  return news;
}

}  // namespace pitwall::telemetry
