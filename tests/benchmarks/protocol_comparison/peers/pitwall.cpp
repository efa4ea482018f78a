// Our own protocol: both ends as car and base run them, over UDP sockets. The car samples its state
// and polls at 100 Hz, as the vehicle's loop does: the hundred signals and the safety groups. What
// the base has is told by class: the oldest of the safety groups, of the motion groups, and of all
// hundred signals. Times are those of the samples: every value tells the tick of its sample, so
// nothing here relies on what the protocol says of ages. Bulk is counted by pieces: an object that
// is replaced before it is whole never comes whole.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "protocol/telemetry/endpoint/car_endpoint.hpp"
#include "protocol/telemetry/endpoint/station_endpoint.hpp"
#include "protocol/telemetry/packet/vehicle_state.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "tests/benchmarks/protocol_comparison/peers/peer.hpp"
#include "tests/benchmarks/radio/virtual_radio.hpp"

namespace pitwall::peers {
namespace {

using namespace telemetry;  // NOLINT: the peer of this one module

constexpr Duration kTick = milliseconds(10);
constexpr UdpAddress kCar{0x0A4D0001, 24'001}, kBase{0x0A4D0002, 24'000};
constexpr std::int64_t kTicksBack = 1'000;  // an older sample is not looked for

GroupSet safety_groups() {
  GroupSet set;
  for (const GroupRow& row : kGroupTable)
    if (row.direction == Direction::kDown && row.priority == Class::kSafety) set.add(row.group);
  return set;
}

GroupSet motion_groups() {
  GroupSet set;
  for (const Group group : kVehicleStateGroups)
    if (row_of(group).priority == Class::kMotion) set.add(group);
  return set;
}

// The keys of both, from a seed that both know: a bench's, no secret.
LinkEndpointConfig config_of(bool car) {
  SeededRandomness randomness(1);
  KeyFile keys{.role = Role::kCar, .own = make_identity(randomness), .peer = {}};
  KeyFile others{
      .role = Role::kBase, .own = make_identity(randomness), .peer = keys.own.public_key};
  keys.peer = others.own.public_key;
  LinkEndpointConfig config;
  if (car) config.association.peer[0] = {kBase.ip, kBase.port};
  config.association.keys = car ? std::move(keys) : std::move(others);
  return config;
}

transport::UdpSocket open_socket(UdpAddress here) {
  auto socket = transport::UdpSocket::bind(here);
  if (socket) return *std::move(socket);
  std::fprintf(stderr, "%s\n", to_string(socket.error()).c_str());
  std::exit(1);
}

void send(transport::UdpSocket& socket, const Outgoing& out) { socket.send_to(out.to, out.bytes); }

template <class End>
void feed_all(End&& feed, transport::UdpSocket& socket,
              std::vector<transport::UdpDatagram>& batch) {
  while (const std::size_t count = socket.receive(batch))
    for (std::size_t i = 0; i < count; ++i) feed(batch[i].payload(), batch[i].from, batch[i].at);
}

void sample(Snapshot& snapshot, Instant at) {
  for (FieldIndex i = 0; i < kFieldCount; ++i)
    snapshot.values[i] = radio::VirtualRadio::value_of(i, at.ns / kTick.ns);
  for (const GroupRow& row : kGroupTable)
    if (kVehicleStateSet.has(row.group) || safety_groups().has(row.group))
      snapshot.at(row.group) = at;
}

void drive(const Call& call) {
  SystemRandomness randomness;
  CarEndpoint car(config_of(true), randomness);
  transport::UdpSocket socket = open_socket(kCar);
  std::vector<transport::UdpDatagram> batch(transport::UdpSocket::kBatch);
  const std::vector<std::uint8_t> bulk(kBulkBytes, 'b');
  Snapshot snapshot;
  const Instant begin = transport::monotonic_now();
  transport::Ticker ticker(kTick, {begin.ns - begin.ns % kTick.ns});
  for (std::int64_t tick = 0; transport::monotonic_now() < call.end; ++tick) {
    const Instant due = ticker.next().deadline, now = transport::monotonic_now();
    feed_all([&](auto bytes, UdpAddress from, Instant at) { car.feed(bytes, 0, from, at); }, socket,
             batch);
    sample(snapshot, due);
    if (call.bulk && tick % (kBulkPeriod / kTick) == 0) car.offer(BulkKind::kPath, bulk);
    while (const auto out = car.poll(snapshot, now)) send(socket, *out);
  }
}

// When the values of the group were taken: the newest tick that has exactly these.
std::optional<Instant> taken_at(const Snapshot& state, Group group, Instant now) {
  const auto [first, count] = fields_of(group);
  const std::int64_t newest = now.ns / kTick.ns;
  for (std::int64_t tick = newest; tick > newest - kTicksBack; --tick) {
    bool fits = true;
    for (FieldIndex i = first; fits && i < first + count; ++i)
      fits = state.values[i] == radio::VirtualRadio::value_of(i, tick);
    if (fits) return Instant{tick * kTick.ns};
  }
  return std::nullopt;
}

// What the base has, and the streams that are told of it.
class Onlooker {
 public:
  void saw(const Arrival& arrival, const Snapshot& state, Instant now) {
    for (const GroupRow& row : kGroupTable)
      if (arrival.groups.has(row.group))
        if (const auto at = taken_at(state, row.group, now)) taken_[index_of(row.group)] = *at;
    tell(safety_groups(), " safety");
    tell(motion_groups(), " motion");
    tell(kVehicleStateSet, " all 100 signals");
  }

 private:
  // The oldest of these; nothing before each has come.
  void tell(GroupSet groups, const char* stream) const {
    Instant oldest{std::numeric_limits<std::int64_t>::max()};
    for (const GroupRow& row : kGroupTable)
      if (groups.has(row.group)) oldest = std::min(oldest, taken_[index_of(row.group)]);
    if (oldest > Instant{}) note_arrival(oldest.ns, stream);
  }

  std::array<Instant, kGroups> taken_{};
};

// Bytes of bulk that came since the call before, each piece once, whole objects or not.
class BulkCount {
 public:
  void tell(const StationEndpoint& station, Instant now) {
    if (now < next_) return;
    next_ = now + kEvery;
    const BulkCounters counters = station.report(now).bulk;
    const std::uint64_t pieces = counters.pieces - counters.repeated;
    if (pieces > reported_) note_bulk((pieces - reported_) * kBulkPiece);
    reported_ = pieces;
  }

 private:
  static constexpr Duration kEvery = milliseconds(100);
  Instant next_{};
  std::uint64_t reported_ = 0;
};

void listen(const Call& call) {
  SystemRandomness randomness;
  StationEndpoint station(config_of(false), randomness);
  transport::UdpSocket socket = open_socket(kBase);
  std::vector<transport::UdpDatagram> batch(transport::UdpSocket::kBatch);
  Onlooker onlooker;
  BulkCount bulk;
  while (transport::monotonic_now() < call.end) {
    const std::array watched{socket.fd()};
    transport::wait_readable(watched, std::min(call.end, station.due()));
    feed_all(
        [&](auto bytes, UdpAddress from, Instant at) {
          if (const auto arrival = station.feed(bytes, 0, from, at))
            onlooker.saw(*arrival, station.state(), transport::monotonic_now());
          while (const auto out = station.poll(transport::monotonic_now())) send(socket, *out);
        },
        socket, batch);
    while (const auto out = station.poll(transport::monotonic_now())) send(socket, *out);
    while (station.next_bulk()) {
    }
    bulk.tell(station, transport::monotonic_now());
  }
}

}  // namespace
}  // namespace pitwall::peers

int main(int argc, char** argv) {
  const auto call = pitwall::peers::call_of(argc, argv);
  call.car ? pitwall::peers::drive(call) : pitwall::peers::listen(call);
  return 0;
}
