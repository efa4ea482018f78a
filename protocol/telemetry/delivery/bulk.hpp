// Large things in pieces: paths, point sets, parameter dumps. First to starve: they get what room
// the packets have left.
//   wire   kBulk: object u16, kind u8, total bytes u24, offset u24, bytes; kBulkAck: object u16,
//          bits of the pieces that came (see .cpp)
//   law    an object is handed out whole and once, after its CRC-32 was checked, or not at all. Of
//          one slot (kind) the newest object wins: an older one that is not complete is dropped and
//          counted. Pieces may come in any order, twice, or not at all; lost ones are sent again
//   bound  kBulkObject bytes, kBulkSlots at once; a larger one is refused by offer()
//   cost   no allocation after construction
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/packet/received.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr std::size_t kBulkObject = 64 * 1'024, kBulkPiece = 200;

enum class BulkKind : std::uint8_t { kPath, kOpponentPaths, kPoints, kParameters, kSchema, kLog };
inline constexpr std::size_t kBulkKinds = 6;

struct BulkCounters {
  std::uint64_t objects = 0, delivered = 0, superseded = 0, pieces = 0, repeated = 0;
  std::uint64_t refused = 0, malformed = 0, bad_checksum = 0;
};

class BulkSender {
 public:
  BulkSender();
  // A new object of the kind; replaces one that is not delivered. False: too large or empty.
  bool offer(BulkKind kind, std::span<const std::uint8_t> bytes);
  bool idle() const;
  void fill(BodyWriter& body, Duration round_trip, Instant now);
  bool take(const Record& record, const Received& received);  // kBulkAck
  void peer_restarted();
  const BulkCounters& counters() const { return counters_; }

 private:
  std::vector<std::uint8_t> store_;
  BulkCounters counters_;
};

class BulkReceiver {
 public:
  BulkReceiver();
  bool take(const Record& record, const Received& received);  // kBulk
  struct Object {
    BulkKind kind;
    std::span<const std::uint8_t> bytes;  // until the next take()
  };
  std::optional<Object> next();
  void fill(BodyWriter& body, Instant now);  // kBulkAck
  void peer_restarted();
  const BulkCounters& counters() const { return counters_; }

 private:
  std::vector<std::uint8_t> store_;
  BulkCounters counters_;
};

}  // namespace pitwall::telemetry
