// Transfer of large objects in pieces: paths, point sets, parameter dumps. Lowest priority: they
// use the room that is left in the packets.
//   wire   kBulk: object u16, kind u8, total bytes u24, first piece u16, one or more pieces. The
//          pieces divide the object followed by its CRC-32 (IEEE 802.3, u32); all have kBulkPiece
//          bytes except the last
//          kBulkAck: object u16, kind u8, first missing piece u16, then one bit for each following
//          piece: whether it was received; trailing zero bytes are omitted
//   invariants
//          an object is delivered whole and once, after a check of its CRC-32, or not at all. Of
//          each slot (kind) the newest object wins: an older, incomplete one is dropped and
//          counted. Pieces may arrive in any order, repeated, or not at all; lost ones are sent
//          again. The kinds take turns
//   bound  kBulkObject bytes per object, one object per kind at once; offer() refuses a larger one
//   cost   no allocation after construction
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr std::size_t kBulkObject = 64 * 1'024, kBulkPiece = 64;
inline constexpr std::size_t kBulkStream = kBulkObject + sizeof(std::uint32_t);
inline constexpr std::size_t kBulkPieces = (kBulkStream + kBulkPiece - 1) / kBulkPiece;
// Pieces after the first missing one that fit into an acknowledgement; none beyond is sent.
inline constexpr std::size_t kBulkWindow = 256;

enum class BulkKind : std::uint8_t { kPath, kOpponentPaths, kPoints, kParameters, kSchema, kLog };
inline constexpr std::size_t kBulkKinds = 6;

// Sender, in order: objects offered, acknowledged whole, replaced before that, pieces sent, of
// these repeated, objects refused by offer(), malformed or impossible acknowledgements. Receiver:
// objects begun, delivered, replaced before that, pieces received, of these repeated, records of
// older objects, malformed records, objects with a wrong checksum.
struct BulkCounters {
  std::uint64_t objects = 0, delivered = 0, superseded = 0, pieces = 0, repeated = 0;
  std::uint64_t refused = 0, malformed = 0, bad_checksum = 0;
};

class BulkSender {
 public:
  BulkSender();
  // New object of the kind; replaces one that is not delivered yet. False: too large or empty.
  bool offer(BulkKind kind, std::span<const std::uint8_t> bytes);
  bool idle() const;
  void fill(BodyWriter& body, Duration round_trip, Instant now);
  bool take(const Record& record, const Received& received);  // kBulkAck
  void peer_restarted();  // restarts the transfer of all objects not delivered
  const BulkCounters& counters() const { return counters_; }

 private:
  struct Piece {
    Instant sent_at{};
    bool sent = false, acknowledged = false;
  };
  struct Slot {
    std::uint16_t object = 0;
    std::size_t bytes = 0;    // 0: nothing to send
    std::size_t missing = 0;  // first piece that is not acknowledged

    std::size_t stream() const { return bytes + sizeof(std::uint32_t); }
    std::size_t pieces() const { return (stream() + kBulkPiece - 1) / kBulkPiece; }
  };

  std::span<std::uint8_t> stream(std::size_t kind);
  std::span<Piece> pieces(std::size_t kind);
  bool send(BodyWriter& body, std::size_t kind, Duration patience, Instant now);
  bool write(BodyWriter& body, std::size_t kind, std::size_t first,
             std::span<const std::uint8_t> run) const;
  bool refuse();

  std::vector<std::uint8_t> store_;
  std::vector<Piece> pieces_;
  std::array<Slot, kBulkKinds> slots_{};
  std::uint16_t last_object_ = 0;
  std::size_t turn_ = 0;  // kind that comes first in the next packet
  BulkCounters counters_;
};

class BulkReceiver {
 public:
  BulkReceiver();
  bool take(const Record& record, const Received& received);  // kBulk
  struct Object {
    BulkKind kind;
    std::span<const std::uint8_t> bytes;  // valid until the next take()
  };
  std::optional<Object> next();
  void fill(BodyWriter& body, Instant now);  // kBulkAck
  void peer_restarted();
  const BulkCounters& counters() const { return counters_; }

 private:
  enum class Stage : std::uint8_t { kNone, kComing, kWhole, kDone };
  struct Slot {
    Stage stage = Stage::kNone;
    std::uint16_t object = 0;
    std::size_t bytes = 0;
    std::size_t missing = 0;  // first missing piece
    std::size_t end = 0;      // one past the last received piece
    bool ack_due = false;

    std::size_t stream() const { return bytes + sizeof(std::uint32_t); }
    std::size_t pieces() const { return (stream() + kBulkPiece - 1) / kBulkPiece; }
  };

  std::span<std::uint8_t> stream(std::size_t kind);
  std::span<std::uint8_t> came(std::size_t kind);
  bool begin(Slot& slot, std::size_t kind, std::uint16_t object, std::size_t bytes);
  void keep(Slot& slot, std::size_t kind, std::size_t first, std::span<const std::uint8_t> bytes);
  void finish(Slot& slot, std::size_t kind);
  bool acknowledge(BodyWriter& body, std::size_t kind);
  bool refuse();

  std::vector<std::uint8_t> store_;
  std::vector<std::uint8_t> piece_received_;  // received pieces by kind and piece: 0 or 1
  std::array<Slot, kBulkKinds> slots_{};
  std::size_t turn_ = 0;
  BulkCounters counters_;
};

}  // namespace pitwall::telemetry
