// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/responder.hpp"

#include <algorithm>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

Responder::Responder(const SessionTerms& terms, const Greeting& own, const StandingKeys& standing,
                     Stamp newest, Randomness& randomness)
    : terms_(terms), own_(own), standing_(&standing), randomness_(&randomness), newest_(newest) {}

std::optional<Refusal> Responder::take(Bytes opening, PathId path, UdpAddress from, Instant now) {
  if (!standing_->usable() || !standing_->opening_fits(opening)) return Refusal::kBadExchange;
  const Stamp stamp = stamp_of(opening);
  if (stamp > newest_ && same(ephemeral_part(opening), done_)) {
    newest_ = stamp;
    return Refusal::kOldExchange;
  }
  if (stamp > newest_) {
    newest_ = stamp;
    waiting_.clear();
    newest_sources_.clear();
  } else if (stamp < newest_ || newest_sources_.empty() || newest_sources_.full() ||
             newest_sources_[0] == from) {
    const bool far = newest_ - stamp > static_cast<Stamp>(kReordered.ns);
    if (far && stale_.is_new(stamp)) send_newer_stamp(opening, path, from, now);
    return Refusal::kOldStamp;
  }
  CHECK(newest_sources_.push(from));
  Waiting waiting{.opening = {}, .path = path, .from = from};
  std::copy(opening.begin(), opening.end(), waiting.opening.begin());
  CHECK(waiting_.push(waiting));
  return std::nullopt;
}

void Responder::send_newer_stamp(Bytes opening, PathId path, UdpAddress from, Instant now) {
  if (!stamp_limit_.take(from, now)) return;
  Reply reply{.to = from};
  reply.size = standing_->write_newer_stamp(newest_, ephemeral_part(opening), reply.bytes);
  newer_stamps_[path] = reply;
}

Responder::Worked Responder::work(std::uint16_t number, const Session* in_use, Instant now) {
  if (waiting_.empty() || !allowed_.take(now)) return {};
  const Waiting one = waiting_[0];
  const bool second = waiting_.size() > 1;
  const Waiting other = waiting_.back();
  waiting_.clear();
  if (second) CHECK(waiting_.push(other));
  const Bytes e = ephemeral_part(one.opening);
  for (auto& pending : pending_) {
    if (!pending || !same(e, ephemeral_part(pending->opening))) continue;
    send_answer(*pending, one, now);
    return {.refusal = std::nullopt, .boot = pending->session.peer.boot};
  }
  return agree(one, number, in_use, now);
}

void Responder::send_answer(Pending& pending, const Waiting& to, Instant now) {
  pending.touched = now;
  standing_->tag_answer(pending.answer, stamp_of(to.opening), ephemeral_part(to.opening));
  Reply reply{.size = kAnswerSize, .to = to.from};
  std::copy(pending.answer.begin(), pending.answer.end(), reply.bytes.begin());
  answers_[to.path] = reply;
  pending.answered[to.path] = to.from;
}

Responder::Worked Responder::agree(const Waiting& one, std::uint16_t number, const Session* in_use,
                                   Instant now) {
  NoiseKk noise(NoiseKk::Side::kResponder, terms_.keys.own, terms_.keys.peer, kPrologue);
  std::array<std::uint8_t, kPayloadSize> bytes{};
  if (!noise.read(noise_part(one.opening), bytes)) return {.refusal = Refusal::kBadExchange};
  const ExchangePayload payload = payload_of(bytes);
  const std::uint64_t boot = payload.greeting.boot;
  const bool renews =
      in_use != nullptr && payload.continues == in_use->own_number && in_use->peer.boot == boot;
  AnswerBytes message{};
  write_header({.kind = Kind::kAnswer, .receiver = payload.number}, message);
  const std::uint16_t continues = renews ? in_use->peer_number : std::uint16_t{0};
  const auto own = bytes_of({.number = number, .continues = continues, .greeting = own_});
  Key ephemeral;
  randomness_->fill(ephemeral.bytes);
  if (!noise.write(ephemeral, own, std::span{message}.subspan(kHeaderSize, kNoiseMessage))) {
    return {.refusal = Refusal::kBadExchange, .boot = boot};
  }
  Pending made{
      .opening = one.opening,
      .answer = message,
      .session = make_session(terms_, noise, number, payload, renews ? in_use : nullptr, now),
      .renews = renews ? in_use->own_number : std::uint16_t{0},
      .touched = now};
  if (payload.greeting.signed_only != own_.signed_only) {
    send_answer(made, one, now);  // so that the car learns why there is no session
    return {.refusal = Refusal::kWrongMode, .boot = boot};
  }
  // The stamp proves that this process came later than others that never got as far as a packet.
  for (auto& other : pending_) {
    const std::uint64_t of = other ? other->session.peer.boot : boot;
    if (of != boot && (in_use == nullptr || of != in_use->peer.boot)) other.reset();
  }
  auto& place = room();
  place = made;
  send_answer(*place, one, now);
  return {.refusal = std::nullopt, .boot = boot};
}

std::optional<Responder::Pending>& Responder::room() {
  return *std::min_element(pending_.begin(), pending_.end(), [](const auto& a, const auto& b) {
    return (a ? a->touched : Instant{INT64_MIN}) < (b ? b->touched : Instant{INT64_MIN});
  });
}

Responder::Pending* Responder::pending(std::uint16_t number, Instant now) {
  for (auto& pending : pending_) {
    if (pending && now - pending->touched >= kPendingLife) pending.reset();
    if (pending && pending->session.own_number == number) return &*pending;
  }
  return nullptr;
}

bool Responder::has_pending(std::uint16_t number) const {
  return std::any_of(pending_.begin(), pending_.end(), [&](const auto& pending) {
    return pending && pending->session.own_number == number;
  });
}

void Responder::confirmed(const Pending& pending) {
  const Bytes e = ephemeral_part(pending.opening);
  std::copy(e.begin(), e.end(), done_.begin());
  for (auto& one : pending_) one.reset();
}

}  // namespace pitwall::telemetry
