// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/link_endpoint.hpp"

#include <algorithm>
#include <utility>

#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::telemetry {
namespace {

constexpr Duration kUnknownRoundTrip = milliseconds(60);
// Acknowledgements come each slot; without any for so long, what leaves may be lost.
constexpr Duration kDoubt = milliseconds(60);
constexpr std::uint64_t kReceiptEvery = 4, kLossEvery = 25;  // slots

const SchemaDescription& schema_of(const LinkEndpointConfig& config) {
  return config.schema ? *config.schema : own_schema();
}

AssociationConfig complete(AssociationConfig config, const SchemaDescription& schema,
                           Randomness& randomness, Greeting& own) {
  std::array<std::uint8_t, 8> drawn{};
  while (config.greeting.boot == 0) {
    randomness.fill(drawn);
    for (const std::uint8_t byte : drawn) config.greeting.boot = config.greeting.boot << 8 | byte;
  }
  if (config.greeting.safety_schema == 0) config.greeting.safety_schema = schema.safety_hash;
  if (config.greeting.whole_schema == 0) config.greeting.whole_schema = schema.whole_hash;
  own = config.greeting;
  return config;
}

}  // namespace

LinkEndpoint::LinkEndpoint(const LinkEndpointConfig& config, Direction sends,
                           Randomness& randomness)
    : own_(),
      association_(complete(config.association, schema_of(config), randomness, own_), randomness),
      threats_(config.association.keys.role, config.association.paths),
      own_schema_(&schema_of(config)),
      schema_(*own_schema_, sends),
      sends_(sends),
      state_(sends, config.early_share),
      policy_(config.policy),
      paths_(config.association.paths),
      lanes_{PathLane(config.budget[0]), PathLane(config.budget[1])} {
  CHECK(paths_ >= 1 && paths_ <= kPaths);
}

Duration LinkEndpoint::round_trip() const {
  return clock_.known() ? clock_.round_trip() : kUnknownRoundTrip;
}

LinkEndpoint::Fed LinkEndpoint::feed(std::span<const std::uint8_t> datagram, PathId path,
                                     UdpAddress from, Instant at) {
  CHECK(path < paths_);
  const auto opened = association_.feed(datagram, path, from, at, plain_);
  Fed fed;
  fed.new_session = note_session(fed.peer_restarted, at);
  if (opened && opened->session == session_) fed.body = open(*opened, datagram.size(), path, at);
  if (fed.body) take_path_records(path, from, at);
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
bool LinkEndpoint::note_session(bool& peer_restarted, Instant at) {
  if (association_.session() == session_) return false;
  session_ = association_.session();
  acked_at_ = at;
  receipts_.forget();
  sent_.forget();
  state_.forget();
  stats_.new_session();
  recent_.fill({});
  path_receipts_.forget();
  plans_.clear();
  next_plan_ = 0;
  for (PathLane& lane : lanes_) lane.newest = lane.reported = 0, lane.proof.reset();
  const auto& peer = association_.peer();
  peer_restarted = peer && peer_boot_ && peer->boot != *peer_boot_;
  if (peer_restarted) clock_.forget();
  if (peer) peer_boot_ = peer->boot;
  if (peer) schema_.begin(peer->whole_schema);
  return true;
}

const ReceivedBody* LinkEndpoint::open(const Opened& opened, std::size_t size, PathId path,
                                       Instant at) {
  auto body = parse_body(opened.body, schema_.reading());
  if (!body) return ++bad_bodies_[static_cast<std::size_t>(body.error())], nullptr;
  received_.body = *body;
  lanes_[path].received_at = at;
  lanes_[path].newest = std::max(lanes_[path].newest, opened.sequence);
  recent_[opened.sequence % recent_.size()] = {opened.sequence, body->tx_time_100us,
                                               body->paths_mask};
  stats_.received(opened.sequence, body->paths_mask, path, size, at);
  receipts_.received(opened.sequence, at);
  const Instant peer_sent = clock_.peer_time(body->tx_time_100us, at);
  if (body->ack) take_ack(*body->ack, peer_sent, at);
  Received& received = received_.received;
  received = {.at = at,
              .sent_earliest = {},
              .tx_time_100us = body->tx_time_100us,
              .sequence = opened.sequence,
              .path = path};
  if (clock_.known()) {
    received.sent_earliest = std::min(clock_.to_own(peer_sent) - clock_.bound(at), at);
    stats_.delay(path, clock_.one_way(peer_sent, at), at);
  }
  return &received_;
}

void LinkEndpoint::take_ack(const Ack& ack, Instant peer_sent, Instant at) {
  const SentPackets::News news = sent_.take(ack);
  for (const Delivery& delivery : news.delivered) state_.acked(delivery.sequence);
  if (!news.delivered.empty()) acked_at_ = at;
  if (!news.newest) return;
  const Instant peer_received = peer_sent - ack.hold;
  clock_.note({news.newest->sent, peer_received, peer_sent, at});
  // By which of several paths it came first, the acknowledgement does not say: kPathReceipt does.
  if (paths_ > 1) return;
  std::size_t bytes = 0;
  for (const Delivery& delivery : news.delivered) bytes += delivery.bytes;
  lanes_[0].rate.delivered(news.newest->sent, peer_received, bytes, at);
}

void LinkEndpoint::take_path_records(PathId path, UdpAddress from, Instant at) {
  const Instant peer_sent = clock_.peer_time(received_.body.tx_time_100us, at);
  for (const Record& record : received_.body.records) {
    const bool token = record.payload.size() == kTokenSize;
    if (record.type == RecordType::kPathProbe && token) {
      lanes_[path].proof = load<std::uint64_t>(record.payload, 0);
    } else if (record.type == RecordType::kPathProof && token) {
      association_.take_proof(path, from, load<std::uint64_t>(record.payload, 0), at);
    } else if (record.type == RecordType::kSchema) {
      schema_.take(record.payload);
    } else if (record.type == RecordType::kPathReceipt) {
      path_receipts_.take(record.payload, lanes(), peer_sent, at);
    }
  }
}

// The copy by the other path, or the same datagram again: no news, but no loss either.
void LinkEndpoint::note_duplicate(std::uint64_t sequence, std::size_t size, PathId path,
                                  Instant at) {
  stats_.received(sequence, 0, path, size, at);
  PathLane& lane = lanes_[path];
  const bool newest = sequence > lane.newest;
  if (newest) lane.newest = sequence, lane.received_at = at;
  const RecentPacket& first = recent_[sequence % recent_.size()];
  if (first.sequence != sequence || !newest || !clock_.known()) return;
  const Instant peer_sent = clock_.peer_time(first.tx_time_100us, at);
  stats_.delay(path, clock_.one_way(peer_sent, at), at);
}

std::optional<Outgoing> LinkEndpoint::take(Instant now, Waits waits) {
  threats_.step(association_.counters(), now);
  if (next_out_ == out_.size()) {
    out_.clear();
    next_out_ = 0;
    // While a stop waits, no reply spends what it needs; without a session it waits for a reply.
    // What a packet that is planned needs is not spent either.
    const bool stop_waits = waits == Waits::kStop && association_.ready();
    if (!stop_waits && next_plan_ == plans_.size()) exchange(now);
  }
  if (next_out_ == out_.size()) return {};
  return out_[next_out_++];
}

// Messages of the key exchange and hints; the budget's like all else. The car's openings are how it
// comes back, hence safety's, and beside a session they take the place of no slot's packet; what a
// base replies to whoever knocks is not.
void LinkEndpoint::exchange(Instant now) {
  if (sends_ == Direction::kDown && association_.ready() && !slots_.is_between(now)) return;
  for (PathId path = 0; path < paths_; ++path) {
    const std::size_t size = association_.poll_size(path, now);
    if (size == 0) continue;
    PathLane& lane = lanes_[path];
    const std::size_t safety = sends_ == Direction::kDown ? size : 0;
    if (!lane.fits(size, safety, now)) {
      lane.budget.note_refused();
      continue;
    }
    const auto sent = association_.poll(path, now, exchange_bytes_[path]);
    if (!sent || sent->bytes.empty()) continue;
    lane.spend(sent->bytes.size(), std::min(safety, sent->bytes.size()), now);
    CHECK(out_.push({path, sent->to, sent->bytes}));
  }
}

std::optional<PacketPlan> LinkEndpoint::plan(Instant now, Waits waits) {
  if (next_plan_ < plans_.size()) return plans_[next_plan_++];
  stats_.advance(now);
  const bool at_once = waits == Waits::kStop && association_.ready();
  const Slots::Turn turn = slots_.turn(now, at_once);
  const bool worth = waits != Waits::kNothing || on_trial() || in_doubt(now);
  const bool wanted = turn == Slots::Turn::kBetween ? worth : turn != Slots::Turn::kNone;
  const bool made = wanted && association_.ready() && lay_out(turn, now);
  slots_.done(turn, made, now);
  due_ = slots_.due(now, at_once && !made);
  if (!made) return {};
  return plans_[next_plan_++];
}

bool LinkEndpoint::on_trial() const {
  for (PathId path = 0; path < paths_; ++path) {
    if (association_.addresses(path).on_trial()) return true;
  }
  return false;
}

// Nothing that was sent is known to arrive: the first packet after a fade shall not wait a slot.
bool LinkEndpoint::in_doubt(Instant now) const { return now - acked_at_ > kDoubt; }

// Which packets go now, and on which paths. False: no path has room.
bool LinkEndpoint::lay_out(Slots::Turn turn, Instant now) {
  plans_.clear();
  next_plan_ = 0;
  for (PathId path = 0; path < paths_; ++path) {
    PathLane& lane = lanes_[path];
    lane.adapt(now);
    if (slots_.count() % kLossEvery == 0) lane.loss = stats_.figures(path, now).loss;
  }
  const bool at_once = turn == Slots::Turn::kAtOnce;
  const PathChoice choice{association_, lanes(), policy_, in_doubt(now), at_once};
  plans_ = choice.plans(turn != Slots::Turn::kOnSlot, now);
  return !plans_.empty();
}

std::size_t LinkEndpoint::room(const PacketPlan& plan, std::size_t safety, Instant now) const {
  std::size_t room = plan.most + kAround;
  for (PathId path = 0; path < paths_; ++path) {
    if (!has(plan.paths, path)) continue;
    room = std::min(room, lanes_[path].budget.room_beside(kAround + safety, now));
  }
  return room > kAround ? room - kAround : 0;
}

LinkEndpoint::PacketRoom LinkEndpoint::room_for(const PacketPlan& plan, std::size_t state,
                                                std::size_t records, Instant now) const {
  const std::size_t groups = kBodyFixed + (receipts_.ack(now) ? kAckSize : 0) + state;
  const std::size_t wanted = groups + records + path_records_size(plan);
  const std::size_t safety = std::min(wanted, plan.safety_room);
  const std::size_t whole = plan.only_safety ? 0 : room(plan, safety, now);
  const std::size_t for_records = safety > groups ? safety - groups : 0;
  if (whole < safety) return {plan.safety_room, for_records, true};
  return {whole, for_records, false};
}

std::size_t LinkEndpoint::safety_reserve(const PacketPlan& plan, const PacketRoom& all,
                                         std::size_t safety, Instant now) const {
  const std::size_t whole = room(plan, safety, now);
  return all.whole > whole ? all.whole - whole : 0;
}

std::size_t LinkEndpoint::path_records_size(const PacketPlan& plan) const {
  std::size_t size = schema_.size();
  for (PathId path = 0; path < paths_; ++path) {
    if (!has(plan.paths, path)) continue;
    if (plan.trial) size += BodyWriter::record_size(kTokenSize);
    if (lanes_[path].proof) size += BodyWriter::record_size(kTokenSize);
    if (paths_ > 1) size += BodyWriter::record_size(PathReceipts::kSize);
  }
  return size;
}

BodyWriter LinkEndpoint::begin(const PacketPlan& plan, std::size_t room, Instant now) {
  BodyWriter body(body_, std::min(room, kMaxBody), schema_.sending());
  body.begin(now, plan.paths);
  if (const auto ack = receipts_.ack(now)) body.add_ack(*ack);
  return body;
}

void LinkEndpoint::add_path_records(BodyWriter& body, const PacketPlan& plan, Instant now) {
  schema_.write(body);
  std::array<std::uint8_t, kTokenSize> bytes{};
  for (PathId path = 0; path < paths_; ++path) {
    PathLane& lane = lanes_[path];
    if (!has(plan.paths, path)) continue;
    if (const auto token = association_.addresses(path).token(); plan.trial && token) {
      store<std::uint64_t>(bytes, 0, *token);
      body.add_record(RecordType::kPathProbe, bytes);
    }
    if (lane.proof) {
      store<std::uint64_t>(bytes, 0, *lane.proof);
      if (body.add_record(RecordType::kPathProof, bytes)) lane.proof.reset();
    }
  }
  if (paths_ > 1 && slots_.count() % kReceiptEvery == 0) PathReceipts::write(body, lanes(), now);
}

std::uint64_t LinkEndpoint::send(const BodyWriter& body, const PacketPlan& plan, std::size_t safety,
                                 Instant now) {
  const auto sealed = association_.seal(body.bytes(), now, datagrams_[next_datagram_]);
  CHECK(sealed.has_value());
  next_datagram_ = (next_datagram_ + 1) % datagrams_.size();
  const std::size_t size = sealed->datagram.size();
  sent_.sent(sealed->sequence, now, size + kIpUdpOverhead);
  path_receipts_.sent(sealed->sequence, plan.paths, size + kIpUdpOverhead, now);
  for (PathId path = 0; path < paths_; ++path) {
    if (has(plan.paths, path)) queue_datagram(path, sealed->datagram, plan, kAround + safety, now);
  }
  return sealed->sequence;
}

void LinkEndpoint::queue_datagram(PathId path, std::span<const std::uint8_t> datagram,
                                  const PacketPlan& plan, std::size_t safety, Instant now) {
  const UdpAddress to = plan.trial ? association_.addresses(path).targets(datagram.size()).back()
                                   : association_.addresses(path).proved();
  lanes_[path].spend(datagram.size(), safety, now);
  association_.note_sent(path, to, datagram.size());
  CHECK(out_.push({path, to, datagram}));
}

bool LinkEndpoint::schema_agrees() const {
  const auto& theirs = association_.peer();
  return theirs && theirs->safety_schema == own_.safety_schema;
}

GroupSet LinkEndpoint::sendable_groups() const {
  GroupSet known;
  if (!schema_.may_send()) return known;
  for (const GroupPlace& place : schema_.sending()) {
    if (place.own) known.add(*place.own);
  }
  return known;
}

bool LinkEndpoint::handles(RecordType type) const {
  return type == RecordType::kSchema || type == RecordType::kPathProbe ||
         type == RecordType::kPathProof || type == RecordType::kPathReceipt;
}

void LinkEndpoint::report(LinkReport& out, Instant now) const {
  out.established = association_.ready();
  out.sessions = association_.session();
  out.association = association_.counters();
  out.threats = threats_.active();
  out.bad_bodies = bad_bodies_;
  out.slots = slots_.count();
  out.slots_skipped = slots_.skipped();
  if (clock_.known()) {
    out.round_trip = clock_.round_trip();
    out.clock_offset = clock_.offset();
    out.clock_bound = clock_.bound(now);
  }
  out.both_lost = stats_.both_lost();
  out.ack_nonsense = sent_.nonsense();
  state_.report(out);
  for (PathId path = 0; path < paths_; ++path) {
    const PathLane& lane = lanes_[path];
    PathReport& to = out.paths[path];
    to.received = stats_.figures(path, now);
    to.spent = lane.budget.counters();
    to.budget_use = lane.use(now);
    to.rate_factor = lane.factor;
    to.queue_delay = lane.rate.queue_delay();
    to.peer = association_.addresses(path).proved();
    to.validated = to.peer.known() && !association_.addresses(path).on_trial();
  }
}

}  // namespace pitwall::telemetry
