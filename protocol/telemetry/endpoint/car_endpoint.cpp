// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/car_endpoint.hpp"

#include <algorithm>

#include "protocol/telemetry/registry/schema_listing.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::telemetry {
struct CarEndpoint::Parts {
  Parts(const LinkEndpointConfig& config, Randomness& source)
      : randomness(&source),
        endpoint(config, Direction::kDown, source),
        schema_text(endpoint.schema().safety_text.empty()
                        ? safety_text()
                        : std::string(endpoint.schema().safety_text)),
        ledger(endpoint.own().boot) {
    draw();
  }

  void draw() {
    std::array<std::uint8_t, 2> drawn{};
    randomness->fill(drawn);
    latch.draw(load<std::uint16_t>(drawn, 0));
    drawn_for = latch.challenge();
  }

  void begin_session(bool peer_restarted);
  void receive(const ReceivedBody& incoming);
  void hear_groups(const Body& body, const Received& received);
  void take(const Record& record, const Received& received);

  Randomness* randomness;
  LinkEndpoint endpoint;
  std::string schema_text;  // of the safety groups, made once
  StopLatch latch;
  std::uint16_t drawn_for = 0;
  JoystickReceiver joystick;
  AuthorityView authority;
  CommandLedger ledger;
  EventSender events;
  BulkSender bulk;
  std::optional<Instant> alive_at;
  bool standstill = false;
  std::uint64_t bad_records = 0;
};

void CarEndpoint::Parts::begin_session(bool peer_restarted) {
  if (peer_restarted) {
    latch.base_restarted();
    joystick.base_restarted();
    authority.base_restarted();
    events.peer_restarted();
    bulk.peer_restarted();
  }
  if (endpoint.peer()) ledger.set_peer_boot(endpoint.peer()->boot);
  // The base says what differs; it needs our side of it.
  if (!endpoint.schema_agrees()) bulk.offer(BulkKind::kSchema, as_bytes(schema_text));
}

void CarEndpoint::Parts::receive(const ReceivedBody& incoming) {
  const Received& received = incoming.received;
  if (received.sent_earliest) {
    alive_at = alive_at ? std::max(*alive_at, *received.sent_earliest) : *received.sent_earliest;
  }
  hear_groups(incoming.body, received);
  for (const Record& record : incoming.body.records) take(record, received);
}

// Also those of a packet that was overtaken: each knows by its own numbers what is newer.
void CarEndpoint::Parts::hear_groups(const Body& body, const Received& received) {
  if (body.groups.has(Group::kAuthority)) authority.receive(body.values, received);
  if (body.groups.has(Group::kJoystick)) joystick.receive(body.values, received);
  if (!body.groups.has(Group::kStop)) return;
  if (const auto stop = stop_state_of(body.values)) latch.receive(*stop, received.at);
  if (latch.challenge() != drawn_for) draw();
}

void CarEndpoint::Parts::take(const Record& record, const Received& received) {
  bool good = true;
  switch (record.type) {
    case RecordType::kCommand:
    case RecordType::kCommandResultAck:
      good = ledger.take(record, received, authority);
      break;
    case RecordType::kEventAck:
      good = events.take(record, received);
      break;
    case RecordType::kBulkAck:
      good = bulk.take(record, received);
      break;
    default:
      good = endpoint.handles(record.type);
  }
  if (!good) ++bad_records;
}

CarEndpoint::CarEndpoint(const LinkEndpointConfig& config, Randomness& randomness)
    : parts_(std::make_unique<Parts>(config, randomness)) {}
CarEndpoint::~CarEndpoint() = default;
CarEndpoint::CarEndpoint(CarEndpoint&&) noexcept = default;
CarEndpoint& CarEndpoint::operator=(CarEndpoint&&) noexcept = default;

void CarEndpoint::feed(std::span<const std::uint8_t> datagram, PathId path, UdpAddress from,
                       Instant at) {
  const LinkEndpoint::Fed fed = parts_->endpoint.feed(datagram, path, from, at);
  if (fed.new_session) parts_->begin_session(fed.peer_restarted);
  if (fed.body) parts_->receive(*fed.body);
}

// Content of the packets, as LinkEndpoint::poll() asks for it.
struct CarEndpoint::Sender {
  Waits waits() const {
    return parts.events.waiting() > 0 || !parts.bulk.idle() ? Waits::kContent : Waits::kNothing;
  }
  const Snapshot& sample(Instant) const { return snapshot; }
  std::size_t safety_size() const { return parts.ledger.wanted(); }
  void add_safety(BodyWriter& body, Instant now) { parts.ledger.fill(body, now); }
  void add_others(BodyWriter& body, Instant now) {
    parts.events.fill(body, now);
    parts.bulk.fill(body, parts.endpoint.round_trip(), now);
  }

  Parts& parts;
  const Snapshot& snapshot;
};

std::optional<Outgoing> CarEndpoint::poll(const Snapshot& snapshot, Instant now) {
  return parts_->endpoint.poll(Sender{*parts_, snapshot}, now);
}

Instant CarEndpoint::due() const { return parts_->endpoint.due(); }

OperatorView CarEndpoint::view(Instant now) const {
  return {.stop = parts_->latch.level(),
          .stop_reason = parts_->latch.reason(),
          .stop_challenge = parts_->latch.challenge(),
          .joystick = parts_->joystick.sample(now),
          .joystick_at = parts_->joystick.sampled_at(),
          .authority = parts_->authority.holder(now),
          .alive_at = parts_->alive_at};
}

std::optional<DueCommand> CarEndpoint::next_command(Instant now) {
  Parts& p = *parts_;
  while (const auto due = p.ledger.take_due(now, p.authority)) {
    if (due->command.type != CommandType::kReleaseStop) return due;
    const bool opened =
        p.latch.release(static_cast<std::uint16_t>(due->command.argument), p.standstill);
    p.ledger.decide(due->id, opened ? Outcome::kApplied : Outcome::kRefused, now);
    if (p.latch.challenge() != p.drawn_for) p.draw();
  }
  return {};
}

void CarEndpoint::decide(CommandId id, Outcome outcome, Instant now) {
  parts_->ledger.decide(id, outcome, now);
}

void CarEndpoint::standstill(bool stands) { parts_->standstill = stands; }
bool CarEndpoint::log(const Event& event) { return parts_->events.offer(event); }
bool CarEndpoint::offer(BulkKind kind, std::span<const std::uint8_t> bytes) {
  return parts_->bulk.offer(kind, bytes);
}
void CarEndpoint::place(double station_m, double lap_length_m, Instant now) {
  parts_->endpoint.place(station_m, lap_length_m, now);
}

bool CarEndpoint::schema_agrees() const { return parts_->endpoint.schema_agrees(); }

std::optional<ThreatChange> CarEndpoint::next_threat() { return parts_->endpoint.next_threat(); }

LinkReport CarEndpoint::report(Instant now) const {
  const Parts& p = *parts_;
  LinkReport report;
  p.endpoint.report(report, now);
  report.bad_records = p.bad_records;
  report.ledger = p.ledger.counters();
  report.events = p.events.counters();
  report.bulk = p.bulk.counters();
  return report;
}

}  // namespace pitwall::telemetry
