// SPDX-License-Identifier: Apache-2.0
// Events and bulk objects over the worst network that can be thought of: it loses, doubles, holds
// back and reorders packets as the input says, ends restart, and strangers' records come between.
// Whatever it does, events come once and in order, and objects whole, once, and never after a newer
// one of their kind.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "protocol/telemetry/delivery/bulk.hpp"
#include "protocol/telemetry/delivery/events.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

using namespace pitwall;
using namespace pitwall::telemetry;
using Bytes = std::vector<std::uint8_t>;

struct Network {
  std::unique_ptr<EventSender> event_sender = std::make_unique<EventSender>();
  std::unique_ptr<EventReceiver> event_receiver = std::make_unique<EventReceiver>();
  BulkSender bulk_sender;
  BulkReceiver bulk_receiver;
  std::vector<Bytes> there, back;
  Instant now{1'000'000'000};

  std::uint32_t events_offered = 0, event_expected = 0;
  // A new receiver is told again what the last one could not acknowledge any more.
  bool reported_again = false;
  std::uint32_t lost_again = 0;
  std::map<BulkKind, std::vector<Bytes>> objects;
  std::map<BulkKind, std::size_t> objects_over;  // handed out, or older than one that was
  std::map<BulkKind, bool> last_again;
};

// An object that tells its number and kind in every byte, so that no two are mixed unseen.
Bytes object_of(std::size_t number, BulkKind kind, std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) {
    bytes[i] = static_cast<std::uint8_t>(number * 31 + static_cast<std::size_t>(kind) * 7 + i / 64);
  }
  return bytes;
}

void offer_event(Network& network) {
  Event event{.kind = EventKind::kText, .at = network.now, .payload = {}};
  for (unsigned shift = 0; shift < 32; shift += 8) {
    CHECK(event.payload.push(static_cast<std::uint8_t>(network.events_offered >> shift)));
  }
  network.event_sender->offer(event);
  ++network.events_offered;
}

void offer_object(Network& network, BulkKind kind, std::size_t size) {
  auto& all = network.objects[kind];
  all.push_back(object_of(all.size(), kind, size));
  CHECK(network.bulk_sender.offer(kind, all.back()));
}

template <class Fill>
Bytes packet(const Network& network, std::size_t room, Direction direction, Fill&& fill) {
  Bytes buffer(room);
  BodyWriter writer(buffer, room, direction);
  writer.begin(network.now, 1);
  fill(writer);
  return {writer.bytes().begin(), writer.bytes().end()};
}

void send(Network& network, std::size_t room) {
  network.there.push_back(packet(network, room, Direction::kDown, [&](BodyWriter& body) {
    network.event_sender->fill(body, network.now);
    network.bulk_sender.fill(body, milliseconds(30), network.now);
  }));
  network.back.push_back(packet(network, room, Direction::kUp, [&](BodyWriter& body) {
    network.event_receiver->fill(body, network.now);
    network.bulk_receiver.fill(body, network.now);
  }));
}

void take_there(Network& network, const Bytes& bytes) {
  const auto body = parse_body(bytes, Direction::kDown);
  CHECK(body.has_value());
  const Received received{.at = network.now,
                          .sent_earliest = {},
                          .tx_time_100us = body->tx_time_100us,
                          .sequence = 0,
                          .path = 0};
  for (const Record& record : body->records) {
    const bool good = record.type == RecordType::kEvent
                          ? network.event_receiver->take(record, received)
                          : network.bulk_receiver.take(record, received);
    CHECK(good);
  }
}

void take_back(Network& network, const Bytes& bytes) {
  const auto body = parse_body(bytes, Direction::kUp);
  CHECK(body.has_value());
  for (const Record& record : body->records) {
    const bool good = record.type == RecordType::kEventAck ? network.event_sender->take(record, {})
                                                           : network.bulk_sender.take(record, {});
    CHECK(good);
  }
}

void look_at_events(Network& network) {
  while (const auto event = network.event_receiver->next()) {
    const auto number = load<std::uint32_t>(event->payload.span(), 0);
    if (event->kind == EventKind::kLost) {
      (network.reported_again ? network.lost_again : network.event_expected) += number;
      continue;
    }
    if (network.reported_again) {
      CHECK(number <= network.event_expected + network.lost_again);
    } else {
      CHECK(number == network.event_expected);
    }
    network.reported_again = false;
    network.event_expected = number + 1;
  }
}

void look_at_objects(Network& network) {
  while (const auto object = network.bulk_receiver.next()) {
    const auto& all = network.objects[object->kind];
    std::size_t& over = network.objects_over[object->kind];
    if (network.last_again[object->kind] && over > 0) --over;
    network.last_again[object->kind] = false;
    while (over < all.size() && !std::ranges::equal(object->bytes, all[over])) ++over;
    CHECK(over < all.size());
    ++over;
  }
}

void end_session(Network& network) {
  look_at_events(network);
  look_at_objects(network);
  network.there.clear();
  network.back.clear();
}

void restart_receiver(Network& network) {
  end_session(network);
  *network.event_receiver = {};
  network.bulk_receiver = {};
  network.event_sender->peer_restarted();
  network.bulk_sender.peer_restarted();
  network.reported_again = true;
  network.lost_again = 0;
  for (const auto& [kind, all] : network.objects) network.last_again[kind] = true;
}

// What it had not delivered is gone.
void restart_sender(Network& network) {
  end_session(network);
  *network.event_sender = {};
  network.bulk_sender = {};
  network.event_receiver->peer_restarted();
  network.bulk_receiver.peer_restarted();
  network.event_expected = network.events_offered;
  network.reported_again = false;
  for (const auto& [kind, all] : network.objects) network.objects_over[kind] = all.size();
  network.last_again.clear();
}

// The rest after the last choice: a good network for as long as it takes.
void settle(Network& network) {
  for (int slot = 0; slot < 4'000; ++slot) {
    send(network, kMaxBody);
    for (const Bytes& bytes : network.there) take_there(network, bytes);
    for (const Bytes& bytes : network.back) take_back(network, bytes);
    network.there.clear();
    network.back.clear();
    look_at_events(network);
    look_at_objects(network);
    network.now += milliseconds(20);
    if (network.bulk_sender.idle() && network.event_sender->waiting() == 0) break;
  }
  CHECK(network.bulk_sender.idle() && network.event_sender->waiting() == 0);
  if (network.reported_again && network.event_expected != network.events_offered) {
    network.event_expected += network.lost_again;
  }
  CHECK(network.event_expected == network.events_offered);
  for (const auto& [kind, all] : network.objects) CHECK(network.objects_over[kind] == all.size());
}

void act(Network& network, std::uint8_t what, std::uint8_t how) {
  const auto pick = [&](std::vector<Bytes>& flying, auto&& take) {
    if (flying.empty()) return;
    const std::size_t at = how % flying.size();
    const Bytes bytes = flying[at];
    if ((how & 0x80U) == 0) flying.erase(flying.begin() + static_cast<std::ptrdiff_t>(at));
    take(network, bytes);
  };
  switch (what % 8) {
    case 0:
      return offer_event(network);
    case 1:
      return offer_object(network, static_cast<BulkKind>(how % 3), 1 + std::size_t{how} * how / 4);
    case 2:
      return send(network, kBodyFixed + std::size_t{4} * how);
    case 3:
      return pick(network.there, take_there);
    case 4:
      return pick(network.back, take_back);
    case 5:
      network.now += milliseconds(how);
      return;
    case 6:
      if (how % 2 == 0) network.there.clear();
      if (how % 3 == 0) network.back.clear();
      if (how == 250) restart_receiver(network);
      if (how == 251) restart_sender(network);
      return;
    default:
      look_at_events(network);
      look_at_objects(network);
      return;
  }
}

// Records that no sender of ours wrote: any answer, no harm.
void strangers(std::span<const std::uint8_t> bytes) {
  EventSender event_sender;
  EventReceiver event_receiver;
  BulkSender bulk_sender;
  BulkReceiver bulk_receiver;
  CHECK(bulk_sender.offer(BulkKind::kPath, object_of(1, BulkKind::kPath, 700)));
  event_sender.offer({});
  while (bytes.size() >= 2) {
    const std::size_t size = std::min<std::size_t>(bytes[1], bytes.size() - 2);
    const auto payload = bytes.subspan(2, size);
    switch (bytes[0] % 4) {
      case 0:
        event_receiver.take({RecordType::kEvent, payload}, {});
        break;
      case 1:
        event_sender.take({RecordType::kEventAck, payload}, {});
        break;
      case 2:
        bulk_receiver.take({RecordType::kBulk, payload}, {});
        break;
      default:
        bulk_sender.take({RecordType::kBulkAck, payload}, {});
        break;
    }
    bytes = bytes.subspan(2 + size);
    while (event_receiver.next()) {
    }
    while (const auto object = bulk_receiver.next()) {
      CHECK(!object->bytes.empty() && object->bytes.size() <= kBulkObject);
    }
    CHECK(event_sender.waiting() <= 1);
  }
  Bytes buffer(kMaxBody);
  BodyWriter writer(buffer, kMaxBody, Direction::kDown);
  writer.begin({}, 1);
  event_receiver.fill(writer, {});
  bulk_receiver.fill(writer, {});
  event_sender.fill(writer, {});
  bulk_sender.fill(writer, {}, {});
  CHECK(parse_body(writer.bytes(), Direction::kDown).has_value());
}

}  // namespace

// A first byte: odd, a network and pairs of bytes (what, how); even, records of strangers.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  if (data[0] % 2 == 0) {
    strangers({data + 1, size - 1});
    return 0;
  }
  constexpr std::size_t kActions = 500;
  static Network network;
  network = {};
  for (std::size_t i = 1; i + 1 < size && i < kActions; i += 2) act(network, data[i], data[i + 1]);
  settle(network);
  return 0;
}
