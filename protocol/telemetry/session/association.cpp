// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/association.hpp"

#include <algorithm>
#include <string_view>

#include "protocol/telemetry/little_endian.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

// Binds an exchange to this protocol and its version.
constexpr std::array<std::uint8_t, 15> kPrologue = [] {
  constexpr std::string_view kText = "pitwall radio ";
  std::array<std::uint8_t, kText.size() + 1> bytes{};
  std::copy(kText.begin(), kText.end(), bytes.begin());
  bytes.back() = kProtocolVersion;
  return bytes;
}();

}  // namespace

Association::Association(const AssociationConfig& config, Randomness& randomness)
    : config_(config), randomness_(&randomness), standing_(config.keys.own, config.keys.peer) {
  CHECK(config.paths >= 1 && config.paths <= kPaths);
  for (std::size_t i = 0; i < config.paths; ++i) {
    if (config.peer[i].known()) paths_[i].addresses.prove(config.peer[i]);
  }
}

std::optional<Opened> Association::feed(Bytes datagram, PathId path, Address from, Instant now,
                                        std::span<std::uint8_t> plain) {
  CHECK(path < config_.paths && plain.size() >= kMaxBody);
  ++counters_.received;
  last_duplicate_.reset();
  const auto header = parse_header(datagram);
  if (!header) return refuse(Refusal::kHeader), std::nullopt;
  switch (header->kind) {
    case Kind::kOpening:
      take_opening(datagram, path, from, now);
      return std::nullopt;
    case Kind::kAnswer:
      take_answer(*header, datagram, now);
      return std::nullopt;
    case Kind::kCookie:
      take_cookie(datagram, now);
      return std::nullopt;
    case Kind::kUnknown:
      take_hint(*header, datagram, now);
      return std::nullopt;
    case Kind::kSealed:
    case Kind::kSigned:
      return open_data(*header, datagram, path, from, now, plain);
  }
  return std::nullopt;
}

// ---- data

std::optional<Opened> Association::open_data(const Header& header, Bytes datagram, PathId path,
                                             Address from, Instant now,
                                             std::span<std::uint8_t> plain) {
  if (datagram.size() < kHeaderSize + kTagSize) return refuse(Refusal::kHeader), std::nullopt;
  const bool in_use = current_ && current_->own_number == header.receiver;
  Pending* const pending = in_use ? nullptr : pending_of(header.receiver);
  if (!in_use && pending == nullptr) {
    refuse(Refusal::kNoSession);
    hint(header, datagram, path, from, now);
    return std::nullopt;
  }
  if (header.kind != data_kind()) return refuse(Refusal::kWrongMode), std::nullopt;
  Session& session = in_use ? *current_ : pending->session;
  const std::uint64_t phases = session.opener.phases();
  const Opener::Opening opening = session.opener.open(header, datagram, now, plain);
  counters_.phases += session.opener.phases() - phases;
  if (opening.verdict == Opener::Verdict::kForged) return refuse(Refusal::kForged), std::nullopt;
  if (opening.verdict == Opener::Verdict::kTooOld) return refuse(Refusal::kReplayed), std::nullopt;
  if (opening.verdict == Opener::Verdict::kDuplicate) {
    refuse(Refusal::kReplayed);
    ++counters_.duplicates;
    if (!in_use) return std::nullopt;
    last_duplicate_ = opening.number;
    const bool copy = opening.number > paths_[path].newest;
    if (copy) heard(opening.number, datagram.size(), path, from);
    return std::nullopt;
  }
  if (pending != nullptr) confirm(*pending, path, from);
  return accept(opening, datagram, path, from, plain);
}

std::optional<Opened> Association::accept(const Opener::Opening& opening, Bytes datagram,
                                          PathId path, Address from,
                                          std::span<std::uint8_t> plain) {
  attempt_.reset();  // the other end lives and has our keys
  hinted_ = false;
  attempt_life_ = kFirstAttempt;
  heard(opening.number, datagram.size(), path, from);
  ++counters_.opened;
  const bool first = unheard_;
  unheard_ = false;
  return Opened{.body = plain.first(datagram.size() - kHeaderSize - kTagSize),
                .sequence = opening.number,
                .newest = opening.newest,
                .new_session = first,
                .session = sessions_};
}

void Association::heard(std::uint64_t number, std::size_t size, PathId path, Address from) {
  Path& state = paths_[path];
  state.addresses.heard(from, size, number > state.newest, *randomness_);
  state.newest = std::max(state.newest, number);
}

Association::Pending* Association::pending_of(std::uint16_t number) {
  for (auto& pending : pending_) {
    if (pending && pending->session.own_number == number) return &*pending;
  }
  return nullptr;
}

void Association::confirm(Pending& pending, PathId path, Address from) {
  // The keys came to who was sent the answer: its address is proved.
  if (pending.answered[path] == from) paths_[path].addresses.prove(from);
  begin_session(pending.session);
  for (auto& other : pending_) other.reset();
}

void Association::begin_session(const Session& session) {
  current_ = session;
  peer_ = session.peer;
  ++sessions_;
  ++counters_.exchanges;
  unheard_ = true;
  for (Path& path : paths_) path.newest = 0;
}

// A base that lost its keys tells the car so; never more bytes than it was sent.
void Association::hint(const Header& header, Bytes datagram, PathId path, Address from,
                       Instant now) {
  if (config_.keys.role != Role::kBase || datagram.size() < kUnknownSize) return;
  if (!hints_.take(now)) return;
  Reply reply{.to = from};
  reply.size = standing_.write_unknown(header, reply.bytes);
  paths_[path].note = reply;
  ++counters_.hints;
}

std::optional<Association::Sealed> Association::seal(Bytes body, Instant now,
                                                     std::span<std::uint8_t> out) {
  if (!current_) return std::nullopt;
  const std::size_t size = kHeaderSize + body.size() + kTagSize;
  CHECK(body.size() <= kMaxBody && out.size() >= size);
  const std::uint64_t phases = current_->sealer.phases();
  const std::uint64_t number =
      current_->sealer.seal(data_kind(), current_->peer_number, body, now, out.first(size));
  counters_.phases += current_->sealer.phases() - phases;
  ++counters_.sealed;
  return Sealed{.datagram = out.first(size), .sequence = number};
}

// ---- the base's side of the exchange

void Association::take_opening(Bytes datagram, PathId path, Address from, Instant now) {
  if (config_.keys.role != Role::kBase || !standing_.usable() ||
      !standing_.opening_fits(datagram)) {
    return refuse(Refusal::kBadExchange);
  }
  if (repeats_known(datagram, path, from)) return;
  switch (guard_.judge(datagram, path, from, now, *randomness_)) {
    case KnockGuard::Answer::kNothing:
      return refuse(Refusal::kTooManyKnocks);
    case KnockGuard::Answer::kAskCookie: {
      refuse(Refusal::kCookieWanted);
      StandingKeys::CookieNonce nonce{};
      randomness_->fill(nonce);
      Reply reply{.to = from};
      reply.size = standing_.write_cookie(guard_.cookie_for(path, from), nonce,
                                          ephemeral_part(datagram), reply.bytes);
      paths_[path].note = reply;
      return;
    }
    case KnockGuard::Answer::kLetIn:
      return answer(datagram, path, from, now);
  }
}

// One that waits for its first packet is answered as before; any other was worked on already.
bool Association::repeats_known(Bytes datagram, PathId path, Address from) {
  const Bytes e = ephemeral_part(datagram);
  for (auto& pending : pending_) {
    if (!pending || !same(e, ephemeral_part(pending->opening))) continue;
    Reply reply{.size = kAnswerSize, .to = from};
    std::copy(pending->answer.begin(), pending->answer.end(), reply.bytes.begin());
    paths_[path].answer = reply;
    pending->answered[path] = from;
    return true;
  }
  const bool known = std::any_of(recent_.begin(), recent_.end(),
                                 [&](const PublicKey& other) { return same(e, other); });
  if (known) refuse(Refusal::kOldExchange);
  return known;
}

void Association::answer(Bytes datagram, PathId path, Address from, Instant now) {
  NoiseKk noise(NoiseKk::Side::kResponder, config_.keys.own, config_.keys.peer, kPrologue);
  std::array<std::uint8_t, kPayloadSize> bytes{};
  if (!noise.read(noise_part(datagram), bytes)) return refuse(Refusal::kBadExchange);
  const Bytes e = ephemeral_part(datagram);
  std::copy(e.begin(), e.end(), recent_[recent_next_].begin());
  recent_next_ = (recent_next_ + 1) % kRecentOpenings;
  const ExchangePayload payload = payload_of(bytes);
  if (payload.greeting.signed_only != config_.greeting.signed_only) {
    return refuse(Refusal::kWrongMode);
  }
  const std::uint16_t number = fresh_number();
  AnswerBytes message{};
  write_header({.kind = Kind::kAnswer, .receiver = payload.number}, message);
  const auto own = bytes_of({.number = number, .greeting = config_.greeting});
  if (!noise.write(fresh_key(), own, std::span{message}.subspan(kHeaderSize, kNoiseMessage))) {
    return refuse(Refusal::kBadExchange);
  }
  standing_.tag_answer(message, e);
  auto& place = room_for_pending();
  place.emplace(Pending{.opening = {},
                        .answer = message,
                        .session = make_session(noise, number, payload, now),
                        .age_rank = ++pending_rank_});
  std::copy(datagram.begin(), datagram.end(), place->opening.begin());
  repeats_known(datagram, path, from);  // sends it
}

std::optional<Association::Pending>& Association::room_for_pending() {
  return *std::min_element(pending_.begin(), pending_.end(), [](const auto& a, const auto& b) {
    return (a ? a->age_rank : 0) < (b ? b->age_rank : 0);
  });
}

// ---- the car's side of the exchange

void Association::take_answer(const Header& header, Bytes datagram, Instant now) {
  if (!attempt_ || header.receiver != attempt_->number) return refuse(Refusal::kOldExchange);
  if (!standing_.answer_fits(datagram, ephemeral_part(attempt_->opening))) {
    return refuse(Refusal::kBadExchange);
  }
  NoiseKk noise = attempt_->noise;
  std::array<std::uint8_t, kPayloadSize> bytes{};
  if (!noise.read(noise_part(datagram), bytes)) return refuse(Refusal::kBadExchange);
  const ExchangePayload payload = payload_of(bytes);
  if (payload.greeting.signed_only != config_.greeting.signed_only) {
    return refuse(Refusal::kWrongMode);
  }
  begin_session(make_session(noise, attempt_->number, payload, now));
  attempt_.reset();
  hinted_ = false;
}

void Association::take_cookie(Bytes datagram, Instant now) {
  if (!attempt_) return refuse(Refusal::kOldExchange);
  const auto cookie = standing_.read_cookie(datagram, ephemeral_part(attempt_->opening));
  if (!cookie) return refuse(Refusal::kBadExchange);
  if (*cookie == cookie_) return;  // it is shown already
  cookie_ = *cookie;
  standing_.tag_opening(attempt_->opening, cookie_);
  for (Path& path : paths_) path.next_opening = now;
}

void Association::take_hint(const Header& header, Bytes datagram, Instant now) {
  if (config_.keys.role != Role::kCar || !current_) return refuse(Refusal::kForeignBoot);
  if (header.receiver != current_->peer_number ||
      !current_->sealer.sent_lately(header.sequence_low) ||
      now - current_->opener.heard() < kSilenceHints || !standing_.unknown_fits(datagram)) {
    return refuse(Refusal::kForeignBoot);
  }
  ++counters_.hints;
  hinted_ = true;
}

bool Association::opening_wanted(Instant now) const {
  if (config_.keys.role != Role::kCar || !standing_.usable()) return false;
  return !current_ || hinted_ || now - current_->opener.heard() >= kSilenceOpens;
}

bool Association::opening_due(PathId path, Instant now) const {
  const Path& state = paths_[path];
  if (!state.addresses.proved().known()) return false;
  return opening_wanted(now) && (!attempt_ || now >= state.next_opening);
}

void Association::begin_attempt(Instant now) {
  if (attempt_) ++counters_.exchanges_failed;
  const std::uint16_t number = fresh_number();
  attempt_.emplace(Attempt{
      .noise = NoiseKk(NoiseKk::Side::kInitiator, config_.keys.own, config_.keys.peer, kPrologue),
      .opening = {},
      .number = number,
      .since = now,
      .life = attempt_life_});
  attempt_life_ = std::min(2 * attempt_life_, kLongestAttempt);
  auto& opening = attempt_->opening;
  write_header({.kind = Kind::kOpening}, opening);
  const auto own = bytes_of({.number = number, .greeting = config_.greeting});
  CHECK(attempt_->noise.write(fresh_key(), own,
                              std::span{opening}.subspan(kHeaderSize, kNoiseMessage)));
  standing_.tag_opening(opening, cookie_);
  for (Path& path : paths_) path.next_opening = now;
}

// ---- both

std::size_t Association::poll_size(PathId path, Instant now) const {
  CHECK(path < config_.paths);
  const Path& state = paths_[path];
  if (state.answer) return state.answer->size;
  if (state.note) return state.note->size;
  return opening_due(path, now) ? kOpeningSize : 0;
}

std::optional<Association::Due> Association::poll(PathId path, Instant now,
                                                  std::span<std::uint8_t> out) {
  CHECK(path < config_.paths && out.size() >= kMaxExchangeSize);
  Path& state = paths_[path];
  for (std::optional<Reply>* const reply : {&state.answer, &state.note}) {
    if (!*reply) continue;
    std::copy_n((*reply)->bytes.begin(), (*reply)->size, out.begin());
    const Due due{.bytes = out.first((*reply)->size), .to = (*reply)->to};
    reply->reset();
    return due;
  }
  if (!opening_due(path, now)) return std::nullopt;
  if (!attempt_ || now - attempt_->since >= attempt_->life) begin_attempt(now);
  std::copy(attempt_->opening.begin(), attempt_->opening.end(), out.begin());
  state.next_opening = now + kRetry;
  return Due{.bytes = out.first(kOpeningSize), .to = state.addresses.proved()};
}

FixedVector<Address, 2> Association::targets(PathId path, std::size_t size) const {
  return paths_[path].addresses.targets(size);
}

void Association::note_sent(PathId path, Address to, std::size_t size) {
  paths_[path].addresses.note_sent(to, size);
}

std::optional<std::uint64_t> Association::probe(PathId path) const {
  return paths_[path].addresses.token();
}

void Association::take_proof(PathId path, Address from, std::uint64_t token, Instant) {
  if (paths_[path].addresses.take_proof(from, token)) ++counters_.roams;
}

Association::Session Association::make_session(const NoiseKk& noise, std::uint16_t own_number,
                                               const ExchangePayload& payload, Instant now) const {
  const NoiseKk::Keys keys = noise.split();
  const bool car = config_.keys.role == Role::kCar;
  const Key& own = car ? keys.from_initiator : keys.from_responder;
  const Key& theirs = car ? keys.from_responder : keys.from_initiator;
  if (config_.key_log && config_.keys.bench) {
    config_.key_log(key_log_lines(payload.number, own) + key_log_lines(own_number, theirs));
  }
  return {.own_number = own_number,
          .peer_number = payload.number,
          .sealer = Sealer(own, config_.first_sequence, now),
          .opener = Opener(theirs, now),
          .peer = payload.greeting};
}

Kind Association::data_kind() const {
  return config_.greeting.signed_only ? Kind::kSigned : Kind::kSealed;
}

// Not 0, and not one that is in use.
std::uint16_t Association::fresh_number() {
  while (true) {
    std::array<std::uint8_t, sizeof(std::uint16_t)> bytes{};
    randomness_->fill(bytes);
    const auto number = load<std::uint16_t>(bytes, 0);
    const bool taken = (current_ && current_->own_number == number) ||
                       pending_of(number) != nullptr || (attempt_ && attempt_->number == number);
    if (number != 0 && !taken) return number;
  }
}

Key Association::fresh_key() {
  Key key;
  randomness_->fill(key.bytes);
  return key;
}

void Association::refuse(Refusal refusal) {
  ++counters_.refused[static_cast<std::size_t>(refusal)];
}

}  // namespace pitwall::telemetry
