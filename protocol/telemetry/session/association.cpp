// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/association.hpp"

#include <algorithm>

#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {
namespace {

// Another process with the peer's keys is one while the peer was heard so lately.
constexpr Duration kPeerReceived = seconds(1);

SessionTerms terms_of(const AssociationConfig& config) {
  return {config.keys, config.first_sequence, config.key_log};
}

}  // namespace

Association::Association(const AssociationConfig& config, Randomness& randomness)
    : config_(config),
      randomness_(&randomness),
      standing_(config.keys.own, config.keys.peer),
      initiator_(terms_of(config_), config.greeting, standing_, config.to_utc, randomness),
      responder_(terms_of(config_), config.greeting, standing_, config.newest_stamp, randomness) {
  CHECK(config.paths >= 1 && config.paths <= kPaths);
  for (std::size_t i = 0; i < config.paths; ++i) {
    if (config.peer[i].known()) paths_[i].addresses.prove(config.peer[i]);
  }
}

std::optional<Opened> Association::feed(Bytes datagram, PathId path, UdpAddress from, Instant now,
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
    case Kind::kNewerStamp:
      take_newer_stamp(datagram, now);
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
                                             UdpAddress from, Instant now,
                                             std::span<std::uint8_t> plain) {
  if (datagram.size() < kHeaderSize + kTagSize) return refuse(Refusal::kHeader), std::nullopt;
  auto* const pending = responder_.pending(header.receiver, now);
  Opener* const opener = opener_of(header.receiver, pending, now);
  if (opener == nullptr) {
    refuse(Refusal::kNoSession);
    hint(header, datagram, path, from, now);
    return std::nullopt;
  }
  if (header.kind != data_kind()) return refuse(Refusal::kWrongMode), std::nullopt;
  const std::uint64_t phases = opener->phases();
  Opener::Opening opening = opener->open(header, datagram, now, plain);
  counters_.phases += opener->phases() - phases;
  if (opening.verdict == Opener::Verdict::kForged) return refuse(Refusal::kForged), std::nullopt;
  if (opening.verdict == Opener::Verdict::kTooOld) return refuse(Refusal::kReplayed), std::nullopt;
  if (opening.verdict == Opener::Verdict::kDuplicate) {
    refuse(Refusal::kReplayed);
    ++counters_.duplicates;
    if (pending == nullptr) take_duplicate(opening.number, datagram, path, from, now);
    return std::nullopt;
  }
  if (pending != nullptr && !confirm(*pending, path, from, now)) return std::nullopt;
  const bool present_keys = current_->own_number == header.receiver;
  if (former_ && present_keys && !former_->until) former_->until = now + kOldSessionKept;
  return accept(opening, datagram, path, from, now, plain);
}

Opener* Association::opener_of(std::uint16_t number, Responder::Pending* pending, Instant now) {
  if (current_ && current_->own_number == number) return &current_->opener;
  const bool kept = former_ && (!former_->until || now < *former_->until);
  if (kept && former_->own_number == number) return &former_->opener;
  return pending == nullptr ? nullptr : &pending->session.opener;
}

std::optional<Opened> Association::accept(const Opener::Opening& opening, Bytes datagram,
                                          PathId path, UdpAddress from, Instant now,
                                          std::span<std::uint8_t> plain) {
  hinted_ = false;  // the other end lives and has our keys
  // A late packet with the keys before is not newer than what came with the present ones.
  const std::uint64_t newest = current_->opener.window().newest();
  const bool news = opening.newest && opening.number >= newest;
  receive(opening.number, datagram.size(), path, from, now);
  ++counters_.opened;
  const bool first = unreceived_;
  unreceived_ = false;
  return Opened{.body = plain.first(datagram.size() - kHeaderSize - kTagSize),
                .sequence = opening.number,
                .newest = news,
                .new_session = first,
                .session = sessions_};
}

void Association::take_duplicate(std::uint64_t number, Bytes datagram, PathId path, UdpAddress from,
                                 Instant now) {
  last_duplicate_ = number;
  const Path& state = paths_[path];
  if (number > state.newest) return receive(number, datagram.size(), path, from, now);
  const Path::Sender& first = state.senders[number % state.senders.size()];
  if (first.number == number && from != first.from) ++counters_.relayed;
  if (from != state.addresses.proved()) return;
  paths_[path].addresses.receive({.from = from, .number = number}, now, *randomness_);
}

void Association::receive(std::uint64_t number, std::size_t size, PathId path, UdpAddress from,
                          Instant now) {
  Path& state = paths_[path];
  const bool newest = number > state.newest;
  state.addresses.receive({.from = from, .size = size, .number = number, .newest = newest}, now,
                          *randomness_);
  if (!newest) return;
  state.newest = number;
  state.senders[number % state.senders.size()] = {number, from};
  state.received = now;
}

// False where the peer in use lives, and where it should renew a session that is no longer in use.
bool Association::confirm(Responder::Pending& pending, PathId path, UdpAddress from, Instant now) {
  const Session session = pending.session;
  const bool renews = pending.renews != 0;
  const bool reaches = pending.answered[path] == from;
  const bool fits = !renews || (current_ && current_->own_number == pending.renews);
  const bool other = current_ && session.peer.boot != peer_->boot;
  if (other && now - current_->opener.received_at() < kTakeOver) {
    return ++counters_.second_peers, false;
  }
  responder_.confirmed(pending);
  if (!fits) return refuse(Refusal::kNoSession), false;
  begin_session(session, renews, now);
  // The keys came to who was sent the answer: its address is proved.
  if (reaches && (!renews || silent(path, now))) paths_[path].addresses.prove(from);
  return true;
}

void Association::begin_session(const Session& session, bool renews, Instant now) {
  const std::uint64_t next = renews ? current_->sealer.next() : 0;
  former_.reset();
  if (renews) {
    former_.emplace(
        Former{.own_number = current_->own_number, .opener = current_->opener, .until = {}});
  }
  current_ = session;
  keys_since_ = now;
  hinted_ = false;
  ++counters_.exchanges;
  if (renews) {
    current_->sealer.go_on_from(next);
    ++counters_.renewals;
    return;
  }
  peer_ = session.peer;
  ++sessions_;
  unreceived_ = true;
  for (Path& path : paths_) {
    path.newest = 0;
    path.senders = {};
    path.received = now;
  }
}

// A base that lost its keys tells the car so; never more bytes than it was sent.
void Association::hint(const Header& header, Bytes datagram, PathId path, UdpAddress from,
                       Instant now) {
  const auto& waits = paths_[path].hint;
  if (car() || datagram.size() < kUnknownSize || (waits && waits->to == from)) return;
  if (!hints_.take(from, now)) return;
  Reply reply{.to = from};
  reply.size = standing_.write_unknown(header, reply.bytes);
  paths_[path].hint = reply;
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

void Association::take_opening(Bytes datagram, PathId path, UdpAddress from, Instant now) {
  if (car()) return refuse(Refusal::kBadExchange);
  if (const auto refusal = responder_.take(datagram, path, from, now)) return refuse(*refusal);
  answer_openings(now);
}

void Association::answer_openings(Instant now) {
  const auto worked = responder_.work(fresh_number(), in_use(), now);
  if (worked.refusal) refuse(*worked.refusal);
  const bool peer_lives = current_ && now - current_->opener.received_at() < kPeerReceived;
  if (worked.boot != 0 && peer_lives && worked.boot != peer_->boot) ++counters_.second_peers;
}

// ---- the car's side of the exchange

void Association::take_answer(const Header& header, Bytes datagram, Instant now) {
  if (!car()) return refuse(Refusal::kBadExchange);
  auto agreed = initiator_.take_answer(header, datagram, in_use(), now);
  if (!agreed) {
    if (initiator_.is_second_answer(header, datagram)) ++counters_.second_peers;
    return refuse(agreed.error());
  }
  begin_session(agreed->session, agreed->renews, now);
  PathAddresses& addresses = paths_[agreed->path].addresses;
  if (addresses.proved() == agreed->reached) return;
  addresses.prove(agreed->reached);
  ++counters_.roams;
}

void Association::take_newer_stamp(Bytes datagram, Instant now) {
  if (!car()) return refuse(Refusal::kBadExchange);
  if (const auto refusal = initiator_.take_newer_stamp(datagram)) return refuse(*refusal);
  for (Path& path : paths_) path.next_opening = std::min(path.next_opening, now);
}

void Association::take_hint(const Header& header, Bytes datagram, Instant now) {
  if (!car() || !current_ || header.receiver != current_->peer_number ||
      !current_->sealer.sent_lately(header.sequence_low) ||
      now - current_->opener.received_at() < kSilenceHints || !standing_.unknown_fits(datagram)) {
    return refuse(Refusal::kForeignBoot);
  }
  ++counters_.hints;
  hinted_ = true;
}

bool Association::silent(PathId path, Instant now) const {
  const auto& received = paths_[path].received;
  return received && now - *received >= kSilenceOpens;
}

bool Association::all_silent(Instant now) const {
  for (PathId path = 0; path < config_.paths; ++path) {
    if (!silent(path, now)) return false;
  }
  return true;
}

// Beside keys that may still be good each opening takes the place of a packet.
Duration Association::retry(std::size_t targets, Instant now) const {
  if (targets > 1 && all_silent(now)) return kSearch;
  if (!current_ || hinted_) return kRetry;
  return kTurnTime / static_cast<std::int64_t>(targets);
}

bool Association::opening_wanted(PathId path, Instant now) const {
  if (!car() || !standing_.usable()) return false;
  return !current_ || hinted_ || now - keys_since_ >= kRenewAfter || silent(path, now);
}

bool Association::opening_due(PathId path, Instant now) const {
  const Path& state = paths_[path];
  return state.addresses.proved().known() && opening_wanted(path, now) && now >= state.next_opening;
}

// The proved one alone while it answers; then the configured ones, too.
Association::Targets Association::opening_targets(PathId path, Instant now) const {
  Targets targets;
  const auto add = [&](UdpAddress address) {
    const bool there = std::find(targets.begin(), targets.end(), address) != targets.end();
    if (address.known() && !there) CHECK(targets.push(address));
  };
  add(paths_[path].addresses.proved());
  if (!silent(path, now)) return targets;
  add(config_.peer[path]);
  for (const UdpAddress spare : config_.spare[path]) add(spare);
  return targets;
}

Association::Due Association::open(PathId path, Instant now, std::span<std::uint8_t> out) {
  Path& state = paths_[path];
  if (!state.received) state.received = now;
  const Targets targets = opening_targets(path, now);
  const UdpAddress to = targets[state.turn++ % targets.size()];
  const std::uint16_t number =
      initiator_.attempt_over(now) ? fresh_number() : initiator_.number().value();
  const Bytes opening = initiator_.opening(path, to, number, in_use(), now);
  counters_.exchanges_failed = initiator_.failed();
  std::copy(opening.begin(), opening.end(), out.begin());
  state.next_opening = now + retry(targets.size(), now);
  return Due{.bytes = out.first(opening.size()), .to = to};
}

// ---- both

template <class Self>
auto Association::replies(Self& self, PathId path) {
  auto* const answer = &self.responder_.answer(path);
  auto* const hint = &self.paths_[path].hint;
  auto* const stamp = &self.responder_.newer_stamp(path);
  return self.paths_[path].hint_first ? std::array{hint, answer, stamp}
                                      : std::array{answer, stamp, hint};
}

std::size_t Association::poll_size(PathId path, Instant now) const {
  CHECK(path < config_.paths);
  if (responder_.wants_work(path, now)) return kAnswerSize;
  for (const auto* const reply : replies(*this, path)) {
    if (*reply) return (*reply)->size;
  }
  return opening_due(path, now) ? kOpeningSize : 0;
}

std::optional<Association::Due> Association::poll(PathId path, Instant now,
                                                  std::span<std::uint8_t> out) {
  CHECK(path < config_.paths && out.size() >= kMaxExchangeSize);
  answer_openings(now);
  for (auto* const reply : replies(*this, path)) {
    if (!*reply) continue;
    std::copy_n((*reply)->bytes.begin(), (*reply)->size, out.begin());
    const Due due{.bytes = out.first((*reply)->size), .to = (*reply)->to};
    paths_[path].hint_first = reply != &paths_[path].hint;
    reply->reset();
    return due;
  }
  if (!opening_due(path, now)) return std::nullopt;
  return open(path, now, out);
}

void Association::take_proof(PathId path, UdpAddress from, std::uint64_t token, Instant now) {
  if (paths_[path].addresses.take_proof(from, token, now)) ++counters_.roams;
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
                       (former_ && former_->own_number == number) ||
                       responder_.has_pending(number) || initiator_.number() == number;
    if (number != 0 && !taken) return number;
  }
}

void Association::refuse(Refusal refusal) {
  ++counters_.refused[static_cast<std::size_t>(refusal)];
}

}  // namespace pitwall::telemetry
