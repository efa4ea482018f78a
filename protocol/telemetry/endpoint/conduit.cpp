// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/conduit.hpp"

#include <algorithm>
#include <utility>

#include "protocol/telemetry/little_endian.hpp"
#include "protocol/telemetry/registry/schema.hpp"

namespace pitwall::telemetry {
namespace {

constexpr std::size_t kAround = kHeaderSize + kTagSize;
// Less body than this is no packet: fixed part, acknowledgement, two groups of safety.
constexpr std::size_t kLeastBody = kBodyFixed + kAckSize + 12;
// Between slots a packet is made only if it carries more than itself.
constexpr std::size_t kLeastBetween = 160;
// A path with so much less room than the best one gets packets of its own.
constexpr std::size_t kMuchLess = 2;
// A path that is silent for so long is not the better one.
constexpr Duration kSilent = milliseconds(60);
constexpr Duration kUnknownRoundTrip = milliseconds(60);
// A budget that had no room is asked again this much later.
constexpr Duration kAskAgain = milliseconds(1);
constexpr std::size_t kTokenSize = 8, kReceiptSize = 5;
constexpr std::uint64_t kReceiptEvery = 4, kLossEvery = 25;  // slots
constexpr Duration kTenth = milliseconds(100);

constexpr std::uint8_t bit_of(PathId path) { return static_cast<std::uint8_t>(1U << path); }
constexpr bool has(std::uint8_t paths, PathId path) { return (paths & bit_of(path)) != 0; }
constexpr std::uint8_t all_of(std::uint8_t paths) {
  return static_cast<std::uint8_t>((1U << paths) - 1);
}
constexpr Direction other(Direction direction) {
  return direction == Direction::kDown ? Direction::kUp : Direction::kDown;
}

AssociationConfig complete(AssociationConfig config, Randomness& randomness, Greeting& own) {
  std::array<std::uint8_t, 8> drawn{};
  while (config.greeting.boot == 0) {
    randomness.fill(drawn);
    for (const std::uint8_t byte : drawn) config.greeting.boot = config.greeting.boot << 8 | byte;
  }
  if (config.greeting.safety_schema == 0) config.greeting.safety_schema = kSafetyHash;
  if (config.greeting.whole_schema == 0) config.greeting.whole_schema = kSchemaHash;
  own = config.greeting;
  return config;
}

}  // namespace

void Conduit::Usage::add(std::size_t count, Instant now) {
  const std::int64_t at = now.ns / kTenth.ns;
  if (at - tenth >= 10) bytes.fill(0);
  for (std::int64_t t = std::max(tenth + 1, at - 9); t <= at; ++t) {
    bytes[static_cast<std::size_t>(t % 10)] = 0;
  }
  tenth = std::max(tenth, at);
  bytes[static_cast<std::size_t>(tenth % 10)] += count;
}

std::uint64_t Conduit::Usage::sum(Instant now) const {
  Usage copy = *this;
  copy.add(0, now);
  std::uint64_t total = 0;
  for (const std::uint64_t b : copy.bytes) total += b;
  return total;
}

Conduit::Way Conduit::make_way(const BudgetParams& params) {
  auto budget = PathBudget::make(params);
  return {std::move(budget).value(),
          RateControl(params.bytes_per_s, params.safety_bytes_per_s),
          1.0,
          {},
          {},
          0,
          0,
          {}};
}

Conduit::Conduit(const ConduitConfig& config, Direction sends, Randomness& randomness)
    : own_(),
      association_(complete(config.association, randomness, own_), randomness),
      sends_(sends),
      policy_(config.policy),
      paths_(config.association.paths),
      ways_{make_way(config.budget[0]), make_way(config.budget[1])} {
  CHECK(paths_ >= 1 && paths_ <= kPaths);
}

Duration Conduit::round_trip() const {
  return clock_.known() ? clock_.round_trip() : kUnknownRoundTrip;
}

Conduit::Fed Conduit::feed(std::span<const std::uint8_t> datagram, PathId path, Address from,
                           Instant at) {
  CHECK(path < paths_);
  const auto opened = association_.feed(datagram, path, from, at, plain_);
  Fed fed;
  fed.new_session = note_session(fed.peer_restarted);
  if (opened && opened->session == session_) fed.heard = open(*opened, datagram.size(), path, at);
  if (fed.heard) take_path_records(path, from, at);
  if (const auto again = association_.last_duplicate()) {
    note_duplicate(*again, datagram.size(), path, at);
  }
  for (PathId p = 0; p < paths_; ++p) {
    if (association_.poll_size(p, at) > 0) due_ = std::min(due_, at);
  }
  return fed;
}

// True where the session in use is another one than before: all that was counted by sequence
// numbers begins anew. The other end's clock is another one only if it restarted.
bool Conduit::note_session(bool& peer_restarted) {
  if (association_.session() == session_) return false;
  session_ = association_.session();
  receipts_.forget();
  sent_.forget();
  stats_.new_session();
  lately_.fill({});
  left_.fill({});
  plans_.clear();
  next_plan_ = 0;
  copy_.reset();
  for (Way& way : ways_) way.newest = way.told = 0, way.proof.reset();
  const auto& peer = association_.peer();
  peer_restarted = peer && peer_boot_ && peer->boot != *peer_boot_;
  if (peer_restarted) clock_.forget();
  if (peer) peer_boot_ = peer->boot;
  return true;
}

const Heard* Conduit::open(const Opened& opened, std::size_t size, PathId path, Instant at) {
  auto body = parse_body(opened.body, other(sends_));
  if (!body) return ++bad_bodies_[static_cast<std::size_t>(body.error())], nullptr;
  heard_.body = *body;
  heard_.delivered.clear();
  ways_[path].heard_at = at;
  ways_[path].newest = std::max(ways_[path].newest, opened.sequence);
  lately_[opened.sequence % lately_.size()] = {opened.sequence, body->tx_time_100us,
                                               body->paths_mask};
  stats_.received(opened.sequence, body->paths_mask, path, size, at);
  receipts_.received(opened.sequence, at);
  const Instant peer_sent = clock_.peer_time(body->tx_time_100us, at);
  if (body->ack) take_ack(*body->ack, peer_sent, at);
  Received& received = heard_.received;
  received = {.at = at,
              .sent_earliest = {},
              .tx_time_100us = body->tx_time_100us,
              .sequence = opened.sequence,
              .path = path};
  if (clock_.known()) {
    received.sent_earliest = std::min(clock_.to_own(peer_sent) - clock_.bound(at), at);
    stats_.delay(path, clock_.one_way(peer_sent, at), at);
  }
  return &heard_;
}

void Conduit::take_ack(const Ack& ack, Instant peer_sent, Instant at) {
  const SentBook::News news = sent_.take(ack);
  heard_.delivered = news.delivered;
  if (!news.newest) return;
  const Instant peer_received = peer_sent - ack.hold;
  clock_.note({news.newest->sent, peer_received, peer_sent, at});
  // By which of several paths it came first, the acknowledgement does not say: kPathReceipt does.
  if (paths_ > 1) return;
  std::size_t bytes = 0;
  for (const Delivery& delivery : news.delivered) bytes += delivery.bytes;
  ways_[0].rate.delivered(news.newest->sent, peer_received, bytes, at);
}

void Conduit::take_path_records(PathId path, Address from, Instant at) {
  const Instant peer_sent = clock_.peer_time(heard_.body.tx_time_100us, at);
  for (const Record& record : heard_.body.records) {
    const bool token = record.payload.size() == kTokenSize;
    if (record.type == RecordType::kPathProbe && token) {
      ways_[path].proof = load<std::uint64_t>(record.payload, 0);
    } else if (record.type == RecordType::kPathProof && token) {
      association_.take_proof(path, from, load<std::uint64_t>(record.payload, 0), at);
    } else if (record.type == RecordType::kPathReceipt && record.payload.size() == kReceiptSize) {
      take_receipt(record.payload, peer_sent, at);
    }
  }
}

// What the peer had last by one path, and for how long.
void Conduit::take_receipt(std::span<const std::uint8_t> payload, Instant peer_sent, Instant at) {
  const std::uint8_t path = payload[0];
  const auto low = load<std::uint16_t>(payload, 1);
  const Duration hold = microseconds(100) * load<std::uint16_t>(payload, 3);
  const Left& left = left_[low % left_.size()];
  if (path >= paths_ || !has(left.paths, path)) return;
  if (static_cast<std::uint16_t>(left.sequence) != low) return;
  ways_[path].rate.delivered(left.at, peer_sent - hold, left.bytes, at);
}

// The copy by the other path, or the same datagram again: no news, but no loss either.
void Conduit::note_duplicate(std::uint64_t sequence, std::size_t size, PathId path, Instant at) {
  stats_.received(sequence, 0, path, size, at);
  Way& way = ways_[path];
  const bool newest = sequence > way.newest;
  if (newest) way.newest = sequence, way.heard_at = at;
  const Lately& first = lately_[sequence % lately_.size()];
  if (first.sequence != sequence || !newest || !clock_.known()) return;
  const Instant peer_sent = clock_.peer_time(first.tx_time_100us, at);
  stats_.delay(path, clock_.one_way(peer_sent, at), at);
}

std::optional<Outgoing> Conduit::take(Instant now) {
  if (next_out_ == out_.size()) {
    out_.clear();
    next_out_ = 0;
    exchange(now);
    if (copy_ && fits(ways_[copy_->path], copy_->bytes.size(), 0, now)) {
      go(*copy_, 0, now);
      copy_.reset();
    }
  }
  if (next_out_ == out_.size()) return {};
  return out_[next_out_++];
}

// Messages of the key exchange and hints; the budget's like all else.
void Conduit::exchange(Instant now) {
  for (PathId path = 0; path < paths_; ++path) {
    const std::size_t size = association_.poll_size(path, now);
    if (size == 0) continue;
    Way& way = ways_[path];
    if (way.budget.room_for_safety(now) < size) {
      way.budget.note_refused();
      continue;
    }
    const auto sent = association_.poll(path, now, exchange_bytes_[path]);
    if (!sent || sent->bytes.empty()) continue;
    way.budget.spend(sent->bytes.size(), sent->bytes.size(), now);
    way.usage.add(sent->bytes.size() + kIpUdpOverhead, now);
    CHECK(out_.push({path, sent->to, sent->bytes}));
  }
}

std::optional<PacketPlan> Conduit::plan(Instant now, bool something_waits) {
  if (next_plan_ < plans_.size()) return plans_[next_plan_++];
  stats_.advance(now);
  if (advance_slot(now)) stage_ = Stage::kDue;
  const Instant half = *slot_ + kSlot / 2;
  bool laid_out = false;
  if (stage_ == Stage::kDue) {
    laid_out = association_.ready() && lay_out(false, now);
    if (!laid_out && now + kAskAgain >= half) ++slots_skipped_;
    if (laid_out || now + kAskAgain >= half) stage_ = Stage::kBetween;
  } else if (stage_ == Stage::kBetween && now + kSlotEarly >= half) {
    laid_out = something_waits && association_.ready() && lay_out(true, now);
    if (laid_out) stage_ = Stage::kDone;
  }
  due_ = stage_ == Stage::kDue || (stage_ == Stage::kBetween && now >= half) ? now + kAskAgain
         : stage_ == Stage::kBetween                                         ? half
                                                                             : *slot_ + kSlot;
  if (!laid_out) return {};
  return plans_[next_plan_++];
}

// Slots are on a grid, so that a poll that comes late moves none of those after it.
bool Conduit::advance_slot(Instant now) {
  if (!slot_) return slot_ = now, ++slots_, true;
  const std::int64_t steps = (now + kSlotEarly - *slot_) / kSlot;
  if (steps <= 0) return false;
  if (stage_ == Stage::kDue) ++slots_skipped_;
  slot_ = *slot_ + kSlot * steps;
  slots_ += static_cast<std::uint64_t>(steps);
  slots_skipped_ += static_cast<std::uint64_t>(steps - 1);
  return true;
}

// Which packets go now, and on which paths. False: no path has room.
bool Conduit::lay_out(bool between, Instant now) {
  plans_.clear();
  next_plan_ = 0;
  copy_.reset();
  for (PathId path = 0; path < paths_; ++path) {
    Way& way = ways_[path];
    way.factor = way.rate.factor(now);
    way.budget.scale(way.factor, now);
    if (slots_ % kLossEvery == 0) loss_[path] = stats_.figures(path, now).loss;
  }
  const std::uint8_t paths = paths_with_room(between, now);
  if (paths == 0) return false;
  if (policy_ == PathPolicy::kBest && paths != bit_of(better_path(paths))) {
    const std::uint8_t best = bit_of(better_path(paths));
    plan_for(best, false, now);
    if (!between) plan_for(static_cast<std::uint8_t>(paths & ~best), true, now);
    return true;
  }
  const std::uint8_t alone = apart(paths, now);
  if (alone != 0 && alone != paths) plan_for(alone, false, now);
  plan_for(alone == paths ? paths : static_cast<std::uint8_t>(paths & ~alone), false, now);
  return true;
}

void Conduit::plan_for(std::uint8_t paths, bool only_safety, Instant now) {
  std::size_t room = kMaxBody;
  for (PathId path = 0; path < paths_; ++path) {
    if (!has(paths, path)) continue;
    room = std::min(room, ways_[path].budget.room_for_safety(now) - kAround);
  }
  CHECK(plans_.push({.paths = paths, .safety_room = room, .only_safety = only_safety}));
}

std::uint8_t Conduit::paths_with_room(bool between, Instant now) const {
  std::uint8_t paths = 0;
  for (PathId path = 0; path < paths_; ++path) {
    const PathBudget& budget = ways_[path].budget;
    const bool room = between ? budget.room_beside(kAround + kLeastBody, now) >=
                                    kAround + kLeastBody + kLeastBetween
                              : budget.room_for_safety(now) >= kAround + kLeastBody;
    if (room && !association_.targets(path, 0).empty()) paths |= bit_of(path);
  }
  return paths;
}

// A path that must prove itself, or that has much less room than the other, has its own packet.
std::uint8_t Conduit::apart(std::uint8_t paths, Instant now) const {
  if (paths != all_of(kPaths)) return 0;
  static_assert(kPaths == 2);
  if (ways_[0].proof || association_.probe(0)) return bit_of(0);
  if (ways_[1].proof || association_.probe(1)) return bit_of(1);
  const std::size_t room[] = {ways_[0].budget.room_beside(kAround + kLeastBody, now),
                              ways_[1].budget.room_beside(kAround + kLeastBody, now)};
  if (room[0] * kMuchLess < room[1]) return bit_of(0);
  if (room[1] * kMuchLess < room[0]) return bit_of(1);
  return 0;
}

PathId Conduit::better_path(std::uint8_t paths) const {
  if (!has(paths, 1)) return 0;
  if (!has(paths, 0)) return 1;
  const Duration ahead = ways_[0].heard_at - ways_[1].heard_at;
  if (ahead > kSilent) return 0;
  if (-ahead > kSilent) return 1;
  return loss_[1] < loss_[0] ? 1 : 0;
}

std::size_t Conduit::room(const PacketPlan& plan, std::size_t safety, Instant now) const {
  std::size_t room = kMaxDatagram;
  for (PathId path = 0; path < paths_; ++path) {
    if (!has(plan.paths, path)) continue;
    room = std::min(room, ways_[path].budget.room_beside(kAround + safety, now));
  }
  return room > kAround ? room - kAround : 0;
}

PacketRoom Conduit::room_for(const PacketPlan& plan, std::size_t state, std::size_t records,
                             Instant now) const {
  const std::size_t groups = kBodyFixed + kAckSize + state;
  const std::size_t wanted = groups + records + path_records_size(plan.paths);
  const std::size_t safety = std::min(wanted, plan.safety_room);
  const std::size_t whole = plan.only_safety ? 0 : room(plan, safety, now);
  const std::size_t for_records = safety > groups ? safety - groups : 0;
  if (whole < safety) return {plan.safety_room, for_records, true};
  return {whole, for_records, false};
}

std::size_t Conduit::kept_from_others(const PacketPlan& plan, const PacketRoom& all,
                                      std::size_t safety, Instant now) const {
  const std::size_t whole = room(plan, safety, now);
  return all.whole > whole ? all.whole - whole : 0;
}

std::size_t Conduit::path_records_size(std::uint8_t paths) const {
  std::size_t size = 0;
  for (PathId path = 0; path < paths_; ++path) {
    if (!has(paths, path)) continue;
    if (association_.probe(path)) size += BodyWriter::record_size(kTokenSize);
    if (ways_[path].proof) size += BodyWriter::record_size(kTokenSize);
    if (paths_ > 1) size += BodyWriter::record_size(kReceiptSize);
  }
  return size;
}

BodyWriter Conduit::begin(const PacketPlan& plan, std::size_t room, Instant now) {
  BodyWriter body(body_, std::min(room, kMaxBody), sends_);
  body.begin(now, plan.paths);
  if (const auto ack = receipts_.ack(now); ack && body.add_ack(*ack)) receipts_.written(now);
  return body;
}

void Conduit::add_path_records(BodyWriter& body, const PacketPlan& plan, Instant now) {
  std::array<std::uint8_t, kTokenSize> bytes{};
  for (PathId path = 0; path < paths_; ++path) {
    Way& way = ways_[path];
    if (!has(plan.paths, path)) continue;
    if (const auto token = association_.probe(path)) {
      store<std::uint64_t>(bytes, 0, *token);
      body.add_record(RecordType::kPathProbe, bytes);
    }
    if (way.proof) {
      store<std::uint64_t>(bytes, 0, *way.proof);
      if (body.add_record(RecordType::kPathProof, bytes)) way.proof.reset();
    }
  }
  if (paths_ > 1 && slots_ % kReceiptEvery == 0) add_receipts(body, now);
}

void Conduit::add_receipts(BodyWriter& body, Instant now) {
  for (PathId path = 0; path < paths_; ++path) {
    Way& way = ways_[path];
    if (way.newest == way.told) continue;
    const std::int64_t hold = (now - way.heard_at) / microseconds(100);
    if (hold < 0 || hold > UINT16_MAX) continue;
    std::array<std::uint8_t, kReceiptSize> bytes{path};
    store<std::uint16_t>(bytes, 1, static_cast<std::uint16_t>(way.newest));
    store<std::uint16_t>(bytes, 3, static_cast<std::uint16_t>(hold));
    if (body.add_record(RecordType::kPathReceipt, bytes)) way.told = way.newest;
  }
}

std::uint64_t Conduit::send(const BodyWriter& body, const PacketPlan& plan, std::size_t safety,
                            Instant now) {
  const auto sealed = association_.seal(body.bytes(), now, datagrams_[next_datagram_]);
  CHECK(sealed.has_value());
  next_datagram_ = (next_datagram_ + 1) % datagrams_.size();
  const std::size_t size = sealed->datagram.size();
  sent_.sent(sealed->sequence, now, size + kIpUdpOverhead);
  left_[sealed->sequence % left_.size()] = {sealed->sequence, now, size + kIpUdpOverhead,
                                            plan.paths};
  for (PathId path = 0; path < paths_; ++path) {
    if (has(plan.paths, path)) put_out(path, sealed->datagram, kAround + safety, now);
  }
  return sealed->sequence;
}

// To the peer's address, and to one that it has yet to prove. The newest address goes first: where
// the peer moved, nothing reaches it under the other.
void Conduit::put_out(PathId path, std::span<const std::uint8_t> datagram, std::size_t safety,
                      Instant now) {
  const auto targets = association_.targets(path, datagram.size());
  for (std::size_t i = targets.size(); i-- > 0;) {
    const Outgoing out{path, targets[i], datagram};
    if (fits(ways_[path], datagram.size(), safety, now)) {
      go(out, safety, now);
    } else {
      copy_ = out;
    }
    safety = 0;  // the copy is paid for by the rest
  }
}

bool Conduit::fits(const Way& way, std::size_t size, std::size_t safety, Instant now) const {
  return way.budget.room_beside(std::min(safety, size), now) >= size;
}

void Conduit::go(const Outgoing& out, std::size_t safety, Instant now) {
  Way& way = ways_[out.path];
  const std::size_t size = out.bytes.size();
  way.budget.spend(size, std::min(safety, size), now);
  way.usage.add(size + kIpUdpOverhead, now);
  association_.note_sent(out.path, out.to, size);
  CHECK(out_.push(out));
}

bool Conduit::schema_agrees() const {
  const auto& theirs = association_.peer();
  return theirs && theirs->safety_schema == own_.safety_schema;
}

GroupSet Conduit::peer_knows() const {
  GroupSet all;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction == sends_) all.add(row.group);
  }
  return all;
}

bool Conduit::takes(RecordType type) const {
  return type == RecordType::kPathProbe || type == RecordType::kPathProof ||
         type == RecordType::kPathReceipt;
}

void Conduit::report(LinkReport& out, Instant now) const {
  out.established = association_.ready();
  out.sessions = association_.session();
  out.association = association_.counters();
  out.bad_bodies = bad_bodies_;
  out.slots = slots_;
  out.slots_skipped = slots_skipped_;
  if (clock_.known()) {
    out.round_trip = clock_.round_trip();
    out.clock_offset = clock_.offset();
    out.clock_bound = clock_.bound(now);
  }
  out.both_lost = stats_.both_lost();
  out.ack_nonsense = sent_.nonsense();
  for (PathId path = 0; path < paths_; ++path) {
    const Way& way = ways_[path];
    PathReport& to = out.paths[path];
    to.heard = stats_.figures(path, now);
    to.spent = way.budget.counters();
    to.budget_use = static_cast<double>(way.usage.sum(now)) / way.budget.params().bytes_per_s;
    to.rate_factor = way.factor;
    to.queue_delay = way.rate.queue_delay();
    to.peer = association_.proved(path);
    to.validated = to.peer.known() && !association_.on_trial(path);
  }
}

}  // namespace pitwall::telemetry
