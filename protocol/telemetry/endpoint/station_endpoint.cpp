// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/station_endpoint.hpp"

#include <algorithm>
#include <vector>

#include "protocol/telemetry/registry/schema_difference.hpp"
#include "protocol/telemetry/registry/schema_listing.hpp"

namespace pitwall::telemetry {

struct StationEndpoint::Parts {
  Parts(const LinkEndpointConfig& config, Randomness& source)
      : endpoint(config, Direction::kUp, source), transmitter(endpoint.own().boot) {}

  void begin_session(bool peer_restarted, Instant now);
  Arrival receive(const ReceivedBody& incoming);
  void take_groups(const ReceivedBody& incoming, Arrival& arrival);
  void take(const Record& record, const Received& received);
  void note_release();
  // A stop that no packet has said yet.
  bool stop_waits() const {
    return stop.state().level != StopLevel::kNone && stop.state() != stop_sent;
  }

  // Content of the packets, as LinkEndpoint::poll() asks for it.
  Waits waits() const { return stop_waits() ? Waits::kStop : Waits::kNothing; }
  Snapshot sample(Instant now);
  std::size_t safety_size() const { return transmitter.wanted() + events.wanted(); }
  void add_safety(BodyWriter& body, Instant now) {
    transmitter.fill(body, now);
    events.fill(body, now);
  }
  void add_others(BodyWriter& body, Instant now) { bulk.fill(body, now); }

  LinkEndpoint endpoint;
  Snapshot state;
  std::array<std::uint64_t, kGroups> sequence_of{};  // of the packet that brought the group
  GroupSet mapped;  // groups whose time was told by compared clocks
  StopTransmitter stop;
  StopState stop_sent, stop_asked;  // in the newest packet; when nothing was left to send
  AuthorityRegister authority;
  JoystickSender joystick;
  CommandTransmitter transmitter;
  std::optional<CommandId> release;  // under way
  EventReceiver events;
  BulkReceiver bulk;
  std::vector<std::uint8_t> schema_of_car = std::vector<std::uint8_t>(kBulkObject);
  std::size_t schema_size = 0;
  std::uint64_t bad_records = 0;
};

void StationEndpoint::Parts::begin_session(bool peer_restarted, Instant now) {
  sequence_of.fill(0);
  if (peer_restarted) {
    // What the car was is no more; nor are its times comparable.
    state = {};
    mapped = {};
    events.peer_restarted();
    bulk.peer_restarted();
    schema_size = 0;
  }
  if (endpoint.peer()) transmitter.set_peer_boot(endpoint.peer()->boot, now);
}

Arrival StationEndpoint::Parts::receive(const ReceivedBody& incoming) {
  const Received& received = incoming.received;
  Arrival arrival{
      .groups = {}, .sequence = received.sequence, .path = received.path, .received = received.at};
  take_groups(incoming, arrival);
  for (const Record& record : incoming.body.records) take(record, received);
  note_release();
  return arrival;
}

// Of two packets the one with the higher number was made later, of samples that are not older.
void StationEndpoint::Parts::take_groups(const ReceivedBody& incoming, Arrival& arrival) {
  const Received& received = incoming.received;
  for (const FieldRow& row : kFields) {
    const std::size_t g = index_of(row.group);
    if (!incoming.body.groups.has(row.group) || received.sequence < sequence_of[g]) continue;
    const auto at = static_cast<FieldIndex>(&row - kFields.data());
    state.values[at] = incoming.body.values[at];
    arrival.groups.add(row.group);
  }
  const Instant sent = received.sent_earliest.value_or(received.at);
  for (const GroupRow& row : kGroupTable) {
    if (!arrival.groups.has(row.group)) continue;
    const std::size_t g = index_of(row.group);
    sequence_of[g] = received.sequence;
    const std::uint8_t code = incoming.body.age_codes[g];
    if (code == kNeverCode) continue;
    // Both this time and the one before are not later than their samples: so is the later of them.
    const Instant sampled = sent - age_of_code(code);
    const bool comparable = mapped.has(row.group) && received.sent_earliest;
    state.at(row.group) = comparable ? std::max(state.at(row.group), sampled) : sampled;
    if (received.sent_earliest) mapped.add(row.group);
  }
}

void StationEndpoint::Parts::take(const Record& record, const Received& received) {
  bool good = true;
  switch (record.type) {
    case RecordType::kCommandResult:
      good = transmitter.take(record, received);
      break;
    case RecordType::kEvent:
      good = events.take(record, received);
      break;
    case RecordType::kBulk:
      good = bulk.take(record, received);
      break;
    default:
      good = endpoint.handles(record.type);
  }
  if (!good) ++bad_records;
}

// The latch that the release opened is asserted no longer.
void StationEndpoint::Parts::note_release() {
  if (!release) return;
  const CommandProgress* progress = transmitter.progress(*release);
  if (progress && !progress->outcome) return;
  if (progress && progress->outcome == Outcome::kApplied) stop.released(*release);
  release.reset();
}

StationEndpoint::StationEndpoint(const LinkEndpointConfig& config, Randomness& randomness)
    : parts_(std::make_unique<Parts>(config, randomness)) {}
StationEndpoint::~StationEndpoint() = default;
StationEndpoint::StationEndpoint(StationEndpoint&&) noexcept = default;
StationEndpoint& StationEndpoint::operator=(StationEndpoint&&) noexcept = default;

std::optional<Arrival> StationEndpoint::feed(std::span<const std::uint8_t> datagram, PathId path,
                                             UdpAddress from, Instant at) {
  const LinkEndpoint::Fed fed = parts_->endpoint.feed(datagram, path, from, at);
  if (fed.new_session) parts_->begin_session(fed.peer_restarted, at);
  if (!fed.body) return {};
  return parts_->receive(*fed.body);
}

std::optional<Outgoing> StationEndpoint::poll(Instant now) {
  const auto out = parts_->endpoint.poll(*parts_, now);
  if (!out) parts_->stop_asked = parts_->stop.state();
  return out;
}

// What the operator wants is sampled when the packet is made.
Snapshot StationEndpoint::Parts::sample(Instant now) {
  stop_sent = stop.state();
  Snapshot snapshot;
  put(stop.state(), snapshot.values);
  joystick.put(snapshot.values, now);
  authority.put(snapshot.values, now);
  for (const Group group : {Group::kStop, Group::kJoystick, Group::kAuthority}) {
    snapshot.at(group) = now;
  }
  return snapshot;
}

Instant StationEndpoint::due() const {
  const bool untried = parts_->stop_waits() && parts_->stop_asked != parts_->stop.state();
  return untried ? Instant{} : parts_->endpoint.due();
}

const Snapshot& StationEndpoint::state() const { return parts_->state; }
bool StationEndpoint::clock_known() const { return parts_->endpoint.clock().known(); }

std::optional<CommandId> StationEndpoint::issue(const Command& command, Instant now) {
  const bool releases = command.type == CommandType::kReleaseStop;
  if (releases && parts_->release) return {};  // of two, the outcome of the first would be missed
  const auto id = parts_->transmitter.issue(command, now);
  if (id && releases) {
    parts_->release = id;
    parts_->stop.release_asked(*id);
  }
  return id;
}

const CommandProgress* StationEndpoint::progress(CommandId id) const {
  return parts_->transmitter.progress(id);
}
const CommandProgress* StationEndpoint::newest(CommandType type) const {
  return parts_->transmitter.newest(type);
}
StopTransmitter& StationEndpoint::stop() { return parts_->stop; }
const StopTransmitter& StationEndpoint::stop() const { return parts_->stop; }
AuthorityRegister& StationEndpoint::authority() { return parts_->authority; }
const AuthorityRegister& StationEndpoint::authority() const { return parts_->authority; }
void StationEndpoint::set_budget_share(double share) {
  CHECK(share > 0.0 && share <= 1.0);
  parts_->endpoint.cap(share);
}
JoystickSender& StationEndpoint::joystick() { return parts_->joystick; }
std::optional<Event> StationEndpoint::next_event() { return parts_->events.next(); }

// The car's registry is for schema_difference(), not for the caller.
std::optional<BulkReceiver::Object> StationEndpoint::next_bulk() {
  while (const auto object = parts_->bulk.next()) {
    if (object->kind != BulkKind::kSchema) return object;
    parts_->schema_size = std::min(object->bytes.size(), parts_->schema_of_car.size());
    std::copy_n(object->bytes.begin(), parts_->schema_size, parts_->schema_of_car.begin());
  }
  return {};
}

const std::optional<Greeting>& StationEndpoint::peer() const { return parts_->endpoint.peer(); }
void StationEndpoint::place(double station_m, double lap_length_m, Instant now) {
  parts_->endpoint.place(station_m, lap_length_m, now);
}
double StationEndpoint::loss_at(std::size_t bin) const {
  return parts_->endpoint.stats().loss_at(bin);
}

Stamp StationEndpoint::newest_stamp() const { return parts_->endpoint.newest_stamp(); }

bool StationEndpoint::schema_agrees() const { return parts_->endpoint.schema_agrees(); }
std::string StationEndpoint::schema_difference() const {
  const Parts& p = *parts_;
  if (schema_agrees() || p.schema_size == 0) return {};
  const std::string theirs(p.schema_of_car.begin(),
                           p.schema_of_car.begin() + static_cast<std::ptrdiff_t>(p.schema_size));
  const std::string_view own = p.endpoint.schema().safety_text;
  return difference(own.empty() ? safety_text() : own, theirs);
}

std::optional<ThreatChange> StationEndpoint::next_threat() {
  return parts_->endpoint.next_threat();
}

LinkReport StationEndpoint::report(Instant now) const {
  const Parts& p = *parts_;
  LinkReport report;
  p.endpoint.report(report, now);
  report.bad_records = p.bad_records;
  report.events = p.events.counters();
  report.bulk = p.bulk.counters();
  return report;
}

}  // namespace pitwall::telemetry
