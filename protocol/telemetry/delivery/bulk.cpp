// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/delivery/bulk.hpp"

#include <algorithm>

#include "protocol/bits/crc.hpp"
#include "protocol/telemetry/little_endian.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr std::size_t kKindAt = 2, kTotalAt = 3, kFirstAt = 6, kBulkFixed = 8;
constexpr std::size_t kMissingAt = 3, kAckFixed = 5;
static_assert(kBulkPieces <= 0xFFFF && kBulkObject <= 0xFF'FFFF);

// A piece that is not acknowledged after a round trip and the slots of both ends is taken for lost.
constexpr Duration kSlots = milliseconds(40), kPatienceMax = seconds(2),
                   kUnknownRoundTrip = milliseconds(200);
constexpr Duration patience_of(Duration round_trip) {
  if (round_trip <= Duration{}) round_trip = kUnknownRoundTrip;
  return std::min(round_trip + round_trip / 2 + kSlots, kPatienceMax);
}

std::uint32_t checksum_at(std::span<const std::uint8_t> stream, std::size_t bytes) {
  return load<std::uint32_t>(stream, bytes);
}

}  // namespace

BulkSender::BulkSender() : store_(kBulkKinds * kBulkStream), pieces_(kBulkKinds * kBulkPieces) {}

std::span<std::uint8_t> BulkSender::stream(std::size_t kind) {
  return std::span(store_).subspan(kind * kBulkStream, slots_[kind].stream());
}

std::span<BulkSender::Piece> BulkSender::pieces(std::size_t kind) {
  return std::span(pieces_).subspan(kind * kBulkPieces, slots_[kind].pieces());
}

bool BulkSender::offer(BulkKind kind, std::span<const std::uint8_t> bytes) {
  if (bytes.empty() || bytes.size() > kBulkObject) {
    ++counters_.refused;
    return false;
  }
  const auto k = static_cast<std::size_t>(kind);
  Slot& slot = slots_[k];
  if (slot.bytes > 0) ++counters_.superseded;
  slot = {.object = ++last_object_, .bytes = bytes.size(), .missing = 0};
  const auto out = stream(k);
  std::copy(bytes.begin(), bytes.end(), out.begin());
  store<std::uint32_t>(out, bytes.size(), bits::crc32_ieee(bytes));
  std::ranges::fill(pieces(k), Piece{});
  ++counters_.objects;
  return true;
}

bool BulkSender::idle() const {
  return std::ranges::all_of(slots_, [](const Slot& slot) { return slot.bytes == 0; });
}

void BulkSender::fill(BodyWriter& body, Duration round_trip, Instant now) {
  const Duration patience = patience_of(round_trip);
  const std::size_t first = turn_;
  for (std::size_t i = 0; i < kBulkKinds; ++i) {
    const std::size_t kind = (first + i) % kBulkKinds;
    if (slots_[kind].bytes == 0) continue;
    while (send(body, kind, patience, now)) turn_ = (kind + 1) % kBulkKinds;
  }
}

// One record: the first piece that is due and those due right after it, as far as there is room.
bool BulkSender::send(BodyWriter& body, std::size_t kind, Duration patience, Instant now) {
  const Slot& slot = slots_[kind];
  const auto all = pieces(kind);
  const std::size_t end = std::min(all.size(), slot.missing + 1 + kBulkWindow);
  const auto due = [&](const Piece& piece) {
    return !piece.acknowledged && (!piece.sent || now - piece.sent_at >= patience);
  };
  std::size_t first = slot.missing;
  while (first < end && !due(all[first])) ++first;
  if (first == end) return false;

  const auto bytes = stream(kind);
  const auto bytes_until = [&](std::size_t piece) {
    return std::min(piece * kBulkPiece, bytes.size()) - first * kBulkPiece;
  };
  const auto fits = [&](std::size_t until) {
    return BodyWriter::record_size(kBulkFixed + bytes_until(until)) <= body.room_left();
  };
  std::size_t last = first;
  while (last < end && due(all[last]) && fits(last + 1)) ++last;
  if (last == first) return false;

  std::array<std::uint8_t, kMaxBody> record;
  store<std::uint16_t>(record, 0, slot.object);
  record[kKindAt] = static_cast<std::uint8_t>(kind);
  store<std::uint16_t>(record, kTotalAt, static_cast<std::uint16_t>(slot.bytes));
  record[kTotalAt + 2] = static_cast<std::uint8_t>(slot.bytes >> 16U);
  store<std::uint16_t>(record, kFirstAt, static_cast<std::uint16_t>(first));
  const auto payload = bytes.subspan(first * kBulkPiece, bytes_until(last));
  std::copy(payload.begin(), payload.end(), record.begin() + kBulkFixed);
  const auto written = std::span<const std::uint8_t>(record).first(kBulkFixed + payload.size());
  if (!body.add_record(RecordType::kBulk, written)) return false;
  for (std::size_t i = first; i < last; ++i) {
    ++counters_.pieces;
    if (all[i].sent) ++counters_.repeated;
    all[i].sent = true;
    all[i].sent_at = now;
  }
  return true;
}

bool BulkSender::take(const Record& record, const Received& /*received*/) {
  CHECK(record.type == RecordType::kBulkAck);
  const auto bytes = record.payload;
  const auto refuse = [&] {
    ++counters_.malformed;
    return false;
  };
  if (bytes.size() < kAckFixed || bytes.size() > kAckFixed + kBulkWindow / 8) return refuse();
  if (bytes[kKindAt] >= kBulkKinds) return refuse();
  if (bytes.size() > kAckFixed && bytes.back() == 0) return refuse();
  const std::size_t kind = bytes[kKindAt];
  Slot& slot = slots_[kind];
  // One of an object that was replaced or is delivered already: late, not wrong.
  if (slot.bytes == 0 || load<std::uint16_t>(bytes, 0) != slot.object) return true;
  const std::size_t missing = load<std::uint16_t>(bytes, kMissingAt);
  const std::size_t count = slot.pieces();
  const auto bitmap = bytes.subspan(kAckFixed);
  const auto came = [&](std::size_t i) { return (bitmap[i / 8] >> (i % 8) & 1U) != 0; };
  for (std::size_t i = 0; i < 8 * bitmap.size(); ++i) {
    if (came(i) && missing + 1 + i >= count) return refuse();
  }
  if (missing > count) return refuse();
  const auto all = pieces(kind);
  for (std::size_t i = slot.missing; i < missing; ++i) all[i].acknowledged = true;
  for (std::size_t i = 0; i < 8 * bitmap.size(); ++i) {
    if (came(i)) all[missing + 1 + i].acknowledged = true;
  }
  while (slot.missing < count && all[slot.missing].acknowledged) ++slot.missing;
  if (slot.missing == count) {
    slot.bytes = 0;
    ++counters_.delivered;
  }
  return true;
}

void BulkSender::peer_restarted() {
  for (std::size_t kind = 0; kind < kBulkKinds; ++kind) {
    if (slots_[kind].bytes == 0) continue;
    slots_[kind].missing = 0;
    std::ranges::fill(pieces(kind), Piece{});
  }
}

BulkReceiver::BulkReceiver() : store_(kBulkKinds * kBulkStream), came_(kBulkKinds * kBulkPieces) {}

std::span<std::uint8_t> BulkReceiver::stream(std::size_t kind) {
  return std::span(store_).subspan(kind * kBulkStream, slots_[kind].stream());
}

std::span<std::uint8_t> BulkReceiver::came(std::size_t kind) {
  return std::span(came_).subspan(kind * kBulkPieces, slots_[kind].pieces());
}

bool BulkReceiver::take(const Record& record, const Received& /*received*/) {
  CHECK(record.type == RecordType::kBulk);
  const auto bytes = record.payload;
  const auto refuse = [&] {
    ++counters_.malformed;
    return false;
  };
  if (bytes.size() <= kBulkFixed || bytes[kKindAt] >= kBulkKinds) return refuse();
  const std::size_t kind = bytes[kKindAt];
  const std::size_t total = load<std::uint16_t>(bytes, kTotalAt) | std::size_t{bytes[kTotalAt + 2]}
                                                                       << 16U;
  const std::size_t first = load<std::uint16_t>(bytes, kFirstAt);
  const auto payload = bytes.subspan(kBulkFixed);
  if (total == 0 || total > kBulkObject) return refuse();
  const std::size_t at = first * kBulkPiece, stream_size = total + sizeof(std::uint32_t);
  if (at >= stream_size || payload.size() > stream_size - at) return refuse();
  const bool to_the_end = payload.size() == stream_size - at;
  if (payload.size() % kBulkPiece != 0 && !to_the_end) return refuse();

  Slot& slot = slots_[kind];
  const auto object = load<std::uint16_t>(bytes, 0);
  if (slot.stage == Stage::kNone || object != slot.object) {
    if (!begin(slot, kind, object, total)) return true;
  } else if (slot.bytes != total) {
    return refuse();
  }
  slot.ack_due = true;
  const std::size_t count = (payload.size() + kBulkPiece - 1) / kBulkPiece;
  counters_.pieces += count;
  if (slot.stage != Stage::kComing) {
    counters_.repeated += count;
    return true;
  }
  const auto have = came(kind);
  for (std::size_t i = 0; i < count; ++i) {
    if (have[first + i] != 0) {
      ++counters_.repeated;
      continue;
    }
    const auto piece = payload.subspan(i * kBulkPiece);
    std::copy_n(piece.begin(), std::min(kBulkPiece, piece.size()),
                stream(kind).begin() + static_cast<std::ptrdiff_t>(at + i * kBulkPiece));
    have[first + i] = 1;
  }
  slot.end = std::max(slot.end, first + count);
  while (slot.missing < have.size() && have[slot.missing] != 0) ++slot.missing;
  if (slot.missing == have.size()) finish(slot, kind);
  return true;
}

// False: the object is older than the one that is known.
bool BulkReceiver::begin(Slot& slot, std::size_t kind, std::uint16_t object, std::size_t bytes) {
  constexpr std::uint16_t kHalf = 0x8000;
  if (slot.stage != Stage::kNone) {
    if (static_cast<std::uint16_t>(object - slot.object) >= kHalf) {
      ++counters_.refused;
      return false;
    }
    if (slot.stage != Stage::kDone) ++counters_.superseded;
  }
  slot = {.stage = Stage::kComing,
          .object = object,
          .bytes = bytes,
          .missing = 0,
          .end = 0,
          .ack_due = true};
  std::ranges::fill(came(kind), std::uint8_t{0});
  ++counters_.objects;
  return true;
}

void BulkReceiver::finish(Slot& slot, std::size_t kind) {
  const auto all = stream(kind);
  if (bits::crc32_ieee(all.first(slot.bytes)) == checksum_at(all, slot.bytes)) {
    slot.stage = Stage::kWhole;
    return;
  }
  ++counters_.bad_checksum;
  slot.stage = Stage::kDone;
}

std::optional<BulkReceiver::Object> BulkReceiver::next() {
  for (std::size_t kind = 0; kind < kBulkKinds; ++kind) {
    Slot& slot = slots_[kind];
    if (slot.stage != Stage::kWhole) continue;
    slot.stage = Stage::kDone;
    ++counters_.delivered;
    return Object{static_cast<BulkKind>(kind), stream(kind).first(slot.bytes)};
  }
  return std::nullopt;
}

void BulkReceiver::fill(BodyWriter& body, Instant /*now*/) {
  const std::size_t first = turn_;
  for (std::size_t i = 0; i < kBulkKinds; ++i) {
    const std::size_t kind = (first + i) % kBulkKinds;
    Slot& slot = slots_[kind];
    if (!slot.ack_due) continue;
    std::array<std::uint8_t, kAckFixed + kBulkWindow / 8> record{};
    store<std::uint16_t>(record, 0, slot.object);
    record[kKindAt] = static_cast<std::uint8_t>(kind);
    store<std::uint16_t>(record, kMissingAt, static_cast<std::uint16_t>(slot.missing));
    std::size_t size = kAckFixed;
    const auto have = came(kind);
    const std::size_t end = std::min(slot.end, slot.missing + 1 + kBulkWindow);
    for (std::size_t piece = slot.missing + 1; piece < end; ++piece) {
      if (have[piece] == 0) continue;
      const std::size_t bit = piece - slot.missing - 1;
      size = kAckFixed + bit / 8 + 1;
      record[size - 1] = static_cast<std::uint8_t>(record[size - 1] | 1U << (bit % 8));
    }
    if (!body.add_record(RecordType::kBulkAck, std::span<const std::uint8_t>(record).first(size))) {
      return;
    }
    slot.ack_due = false;
    turn_ = (kind + 1) % kBulkKinds;
  }
}

void BulkReceiver::peer_restarted() {
  for (Slot& slot : slots_) {
    if (slot.stage == Stage::kComing) ++counters_.superseded;
    // What is whole is still handed out.
    if (slot.stage == Stage::kWhole) continue;
    slot.stage = Stage::kNone;
    slot.ack_due = false;
  }
}

}  // namespace pitwall::telemetry
