// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/initiator.hpp"

#include <algorithm>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {
namespace {

// An attempt that was given up for longer did not fail: nobody wanted its answer any more.
constexpr Duration kAbandoned = seconds(1);

}  // namespace

Initiator::Initiator(const SessionTerms& terms, const Greeting& own, const StandingKeys& standing,
                     Duration to_utc, Randomness& randomness)
    : terms_(terms), own_(own), standing_(&standing), randomness_(&randomness), stamps_(to_utc) {}

bool Initiator::attempt_over(Instant now) const {
  return !attempt_ || now - attempt_->since >= kAttemptLife;
}

std::optional<std::uint16_t> Initiator::number() const {
  if (!attempt_) return std::nullopt;
  return attempt_->number;
}

Bytes Initiator::opening(PathId path, UdpAddress to, std::uint16_t number, const Session* in_use,
                         Instant now) {
  if (attempt_over(now)) begin(number, in_use, now);
  const Stamp stamp = stamps_.next(now);
  standing_->tag_opening(attempt_->opening, stamp);
  attempt_->last = now;
  sent_[next_sent_] = {.stamp = stamp, .path = path, .to = to};
  next_sent_ = (next_sent_ + 1) % sent_.size();
  return attempt_->opening;
}

void Initiator::begin(std::uint16_t number, const Session* in_use, Instant now) {
  if (attempt_ && now - attempt_->last < kAbandoned) ++failed_;
  attempt_.emplace(Attempt{
      .noise = NoiseKk(NoiseKk::Side::kInitiator, terms_.keys.own, terms_.keys.peer, kPrologue),
      .opening = {},
      .number = number,
      .since = now,
      .last = now});
  auto& opening = attempt_->opening;
  write_header({.kind = Kind::kOpening}, opening);
  const std::uint16_t continues = in_use ? in_use->peer_number : std::uint16_t{0};
  const auto payload = bytes_of({.number = number, .continues = continues, .greeting = own_});
  Key ephemeral;
  randomness_->fill(ephemeral.bytes);
  CHECK(attempt_->noise.write(ephemeral, payload,
                              std::span{opening}.subspan(kHeaderSize, kNoiseMessage)));
}

const Initiator::SentOpening* Initiator::sent_with(Stamp stamp) const {
  const auto* const found = std::find_if(
      sent_.begin(), sent_.end(), [&](const SentOpening& sent) { return sent.stamp == stamp; });
  return found == sent_.end() ? nullptr : found;
}

Result<Initiator::Agreed, Refusal> Initiator::take_answer(const Header& header, Bytes datagram,
                                                          const Session* in_use, Instant now) {
  if (!attempt_ || header.receiver != attempt_->number) return Unexpected{Refusal::kOldExchange};
  if (!standing_->answer_fits(datagram, ephemeral_part(attempt_->opening))) {
    return Unexpected{Refusal::kBadExchange};
  }
  const SentOpening* const sent = sent_with(stamp_of(datagram));
  if (sent == nullptr) return Unexpected{Refusal::kOldExchange};
  NoiseKk noise = attempt_->noise;
  std::array<std::uint8_t, kPayloadSize> bytes{};
  if (!noise.read(noise_part(datagram), bytes)) return Unexpected{Refusal::kBadExchange};
  const ExchangePayload payload = payload_of(bytes);
  if (payload.greeting.signed_only != own_.signed_only) return Unexpected{Refusal::kWrongMode};
  const bool renews = payload.continues != 0;
  if (renews && (in_use == nullptr || in_use->own_number != payload.continues)) {
    return Unexpected{Refusal::kOldExchange};
  }
  Agreed agreed{.session = make_session(terms_, noise, attempt_->number, payload,
                                        renews ? in_use : nullptr, now),
                .renews = renews,
                .path = sent->path,
                .reached = sent->to};
  answered_.emplace(
      Answered{.opening = attempt_->opening, .answer = {}, .number = attempt_->number});
  std::copy(datagram.begin(), datagram.end(), answered_->answer.begin());
  attempt_.reset();
  return agreed;
}

bool Initiator::is_second_answer(const Header& header, Bytes datagram) const {
  return answered_ && header.receiver == answered_->number &&
         standing_->answer_fits(datagram, ephemeral_part(answered_->opening)) &&
         stamp_of(datagram) == stamp_of(answered_->answer) &&
         !same(noise_part(datagram), noise_part(answered_->answer));
}

std::optional<Refusal> Initiator::take_newer_stamp(Bytes datagram) {
  if (!attempt_) return Refusal::kOldExchange;
  const auto stamp = standing_->read_newer_stamp(datagram, ephemeral_part(attempt_->opening));
  if (!stamp) return Refusal::kBadExchange;
  stamps_.exceed(*stamp);
  return std::nullopt;
}

}  // namespace pitwall::telemetry
