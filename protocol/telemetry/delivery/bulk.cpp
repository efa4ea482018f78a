// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/delivery/bulk.hpp"

#include <algorithm>

#include "protocol/bits/crc.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr std::size_t kObjectKindAt = 2, kTotalAt = 3, kTotalSize = 3, kFirstAt = 6, kBulkFixed = 8;
constexpr std::size_t kMissingAt = 3, kAckFixed = 5;
static_assert(kBulkPieces <= 0xFFFF && kBulkObject <= 0xFF'FFFF);

// A piece that is not acknowledged after a round trip and the slots of both ends is taken for lost.
constexpr Duration kSlots = milliseconds(40), kPatienceMax = seconds(2),
                   kUnknownRoundTrip = milliseconds(200);
constexpr Duration patience_of(Duration round_trip) {
  if (round_trip <= Duration{}) round_trip = kUnknownRoundTrip;
  return std::min(round_trip + round_trip / 2 + kSlots, kPatienceMax);
}

// A kBulk record; exists only if some sender could have written it.
struct Run {
  std::uint16_t object = 0;
  std::size_t kind = 0, total = 0;
  std::size_t first = 0, count = 0;  // pieces
  std::span<const std::uint8_t> bytes;
};

std::optional<Run> read_run(std::span<const std::uint8_t> record) {
  if (record.size() <= kBulkFixed || record[kObjectKindAt] >= kBulkKinds) return std::nullopt;
  Run run;
  run.object = load<std::uint16_t>(record, 0);
  run.kind = record[kObjectKindAt];
  run.total = load(record.subspan(kTotalAt, kTotalSize));
  run.first = load<std::uint16_t>(record, kFirstAt);
  run.bytes = record.subspan(kBulkFixed);
  run.count = (run.bytes.size() + kBulkPiece - 1) / kBulkPiece;
  if (run.total == 0 || run.total > kBulkObject) return std::nullopt;
  const std::size_t begin = run.first * kBulkPiece, end = run.total + sizeof(std::uint32_t);
  if (begin >= end || run.bytes.size() > end - begin) return std::nullopt;
  const bool to_the_end = run.bytes.size() == end - begin;
  if (run.bytes.size() % kBulkPiece != 0 && !to_the_end) return std::nullopt;
  return run;
}

// A kBulkAck record in its one form.
struct Arrivals {
  std::uint16_t object = 0;
  std::size_t kind = 0, missing = 0;
  std::span<const std::uint8_t> bitmap;  // bit k: piece missing + 1 + k

  bool came(std::size_t k) const { return (bitmap[k / 8] >> (k % 8) & 1U) != 0; }
  std::size_t bits() const { return 8 * bitmap.size(); }
  // One past the last piece that it names.
  std::size_t end() const {
    if (bitmap.empty()) return missing;
    std::size_t k = bits();
    while (!came(k - 1)) --k;
    return missing + 1 + k;
  }
};

std::optional<Arrivals> read_arrivals(std::span<const std::uint8_t> record) {
  if (record.size() < kAckFixed || record.size() > kAckFixed + kBulkWindow / 8) return std::nullopt;
  if (record[kObjectKindAt] >= kBulkKinds) return std::nullopt;
  if (record.size() > kAckFixed && record.back() == 0) return std::nullopt;
  return Arrivals{.object = load<std::uint16_t>(record, 0),
                  .kind = record[kObjectKindAt],
                  .missing = load<std::uint16_t>(record, kMissingAt),
                  .bitmap = record.subspan(kAckFixed)};
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
  const auto due = [&](std::size_t i) {
    const Piece& piece = all[i];
    return !piece.acknowledged && (!piece.sent || now - piece.sent_at >= patience);
  };
  const auto bytes = stream(kind);
  std::size_t first = slot.missing;
  while (first < end && !due(first)) ++first;
  const auto run_until = [&](std::size_t piece) {
    return bytes.first(std::min(piece * kBulkPiece, bytes.size())).subspan(first * kBulkPiece);
  };
  std::size_t last = first;
  while (last < end && due(last) &&
         BodyWriter::record_size(kBulkFixed + run_until(last + 1).size()) <= body.room_left()) {
    ++last;
  }
  if (last == first || !write(body, kind, first, run_until(last))) return false;
  for (Piece& piece : all.subspan(first, last - first)) {
    ++counters_.pieces;
    if (piece.sent) ++counters_.repeated;
    piece.sent = true;
    piece.sent_at = now;
  }
  return true;
}

bool BulkSender::write(BodyWriter& body, std::size_t kind, std::size_t first,
                       std::span<const std::uint8_t> run) const {
  const Slot& slot = slots_[kind];
  std::array<std::uint8_t, kMaxBody> record;
  store<std::uint16_t>(record, 0, slot.object);
  record[kObjectKindAt] = static_cast<std::uint8_t>(kind);
  store(std::span(record).subspan(kTotalAt, kTotalSize), slot.bytes);
  store<std::uint16_t>(record, kFirstAt, static_cast<std::uint16_t>(first));
  std::copy(run.begin(), run.end(), record.begin() + kBulkFixed);
  return body.add_record(RecordType::kBulk,
                         std::span<const std::uint8_t>(record).first(kBulkFixed + run.size()));
}

bool BulkSender::take(const Record& record, const Received& /*received*/) {
  CHECK(record.type == RecordType::kBulkAck);
  const auto arrivals = read_arrivals(record.payload);
  if (!arrivals) return refuse();
  Slot& slot = slots_[arrivals->kind];
  // One of an object that was replaced or is delivered already: late, not wrong.
  if (slot.bytes == 0 || arrivals->object != slot.object) return true;
  const auto all = pieces(arrivals->kind);
  if (arrivals->end() > all.size()) return refuse();
  for (std::size_t i = slot.missing; i < arrivals->missing; ++i) all[i].acknowledged = true;
  for (std::size_t k = 0; k < arrivals->bits(); ++k) {
    if (arrivals->came(k)) all[arrivals->missing + 1 + k].acknowledged = true;
  }
  while (slot.missing < all.size() && all[slot.missing].acknowledged) ++slot.missing;
  if (slot.missing == all.size()) {
    slot.bytes = 0;
    ++counters_.delivered;
  }
  return true;
}

bool BulkSender::refuse() {
  ++counters_.malformed;
  return false;
}

void BulkSender::peer_restarted() {
  for (std::size_t kind = 0; kind < kBulkKinds; ++kind) {
    if (slots_[kind].bytes == 0) continue;
    slots_[kind].missing = 0;
    std::ranges::fill(pieces(kind), Piece{});
  }
}

BulkReceiver::BulkReceiver()
    : store_(kBulkKinds * kBulkStream), piece_received_(kBulkKinds * kBulkPieces) {}

std::span<std::uint8_t> BulkReceiver::stream(std::size_t kind) {
  return std::span(store_).subspan(kind * kBulkStream, slots_[kind].stream());
}

std::span<std::uint8_t> BulkReceiver::came(std::size_t kind) {
  return std::span(piece_received_).subspan(kind * kBulkPieces, slots_[kind].pieces());
}

bool BulkReceiver::take(const Record& record, const Received& /*received*/) {
  CHECK(record.type == RecordType::kBulk);
  const auto run = read_run(record.payload);
  if (!run) return refuse();
  Slot& slot = slots_[run->kind];
  if (slot.stage == Stage::kNone || run->object != slot.object) {
    if (!begin(slot, run->kind, run->object, run->total)) return true;
  } else if (slot.bytes != run->total) {
    return refuse();
  }
  slot.ack_due = true;
  counters_.pieces += run->count;
  if (slot.stage != Stage::kComing) {
    counters_.repeated += run->count;
    return true;
  }
  keep(slot, run->kind, run->first, run->bytes);
  if (slot.missing == slot.pieces()) finish(slot, run->kind);
  return true;
}

bool BulkReceiver::refuse() {
  ++counters_.malformed;
  return false;
}

void BulkReceiver::keep(Slot& slot, std::size_t kind, std::size_t first,
                        std::span<const std::uint8_t> bytes) {
  const auto have = came(kind);
  std::size_t piece = first;
  for (; !bytes.empty(); ++piece) {
    const auto part = bytes.first(std::min(kBulkPiece, bytes.size()));
    bytes = bytes.subspan(part.size());
    if (have[piece] != 0) {
      ++counters_.repeated;
      continue;
    }
    std::ranges::copy(part, stream(kind).subspan(piece * kBulkPiece).begin());
    have[piece] = 1;
  }
  slot.end = std::max(slot.end, piece);
  while (slot.missing < have.size() && have[slot.missing] != 0) ++slot.missing;
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
  if (bits::crc32_ieee(all.first(slot.bytes)) == load<std::uint32_t>(all, slot.bytes)) {
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
    if (!slots_[kind].ack_due) continue;
    if (!acknowledge(body, kind)) return;
    slots_[kind].ack_due = false;
    turn_ = (kind + 1) % kBulkKinds;
  }
}

bool BulkReceiver::acknowledge(BodyWriter& body, std::size_t kind) {
  const Slot& slot = slots_[kind];
  std::array<std::uint8_t, kAckFixed + kBulkWindow / 8> record{};
  store<std::uint16_t>(record, 0, slot.object);
  record[kObjectKindAt] = static_cast<std::uint8_t>(kind);
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
  return body.add_record(RecordType::kBulkAck, std::span<const std::uint8_t>(record).first(size));
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
