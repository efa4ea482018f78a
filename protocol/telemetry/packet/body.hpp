// Body of a data packet after decryption: time of sending, acknowledgement, groups of state,
// records.
//   wire   tx_time u24 (100 us units of the sender's clock, wraps), flags u8
//            flags: has_ack 1, has_groups 2, paths sent on 4 (0x04 << path), 6 bits used
//          [ack: newest u16, mask u32, hold u16 (100 us units, saturates)]
//          [groups: the set, one bit for each group of the direction, whole bytes; one age code for
//           each group of the set; the groups' bits back to back; zeros to a whole byte]
//          records to the end: type u8, length u8 or (length >= 0xF0) two bytes, payload
//   invariants
//          parse_body accepts exactly what BodyWriter writes: each content has one encoding
//   errors BodyError for any other bytes; nothing is read past the end
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/packet/group_codec.hpp"
#include "protocol/telemetry/packet/header.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

// Layout of a sender's packets: the groups of its direction in the order of the bits of their set,
// as its registry defines them. Place k is bit k of the set; a place with a group of our registry
// has that group's size. Two ends whose registries differ read each other's packets by the sender's
// layout and skip unknown groups.
struct GroupPlace {
  std::optional<Group> own;  // empty: our registry does not have the group, or defines it otherwise
  std::uint16_t bits = 0;    // size of its values
};

inline constexpr std::size_t kMaxPlaces = 64;
using Layout = FixedVector<GroupPlace, kMaxPlaces>;

// Size of the set in bytes.
constexpr std::size_t set_size(const Layout& layout) { return (layout.size() + 7) / 8; }

// Layout of our own registry.
const Layout& own_layout(Direction direction);

inline constexpr std::size_t kPaths = 2;
using PathId = std::uint8_t;  // 0 .. kPaths - 1
constexpr std::uint8_t bit_of(PathId path) { return static_cast<std::uint8_t>(1U << path); }
inline constexpr std::size_t kMaxRecords = 48;
inline constexpr std::size_t kBodyFixed = 4, kAckSize = 8;

// Bytes of a set of groups of our registry: the set, their age codes, their values.
constexpr std::size_t state_bytes(GroupSet set, Direction direction) {
  const std::size_t bits = kAgeCodeBits * set.count() + bits_of(set);
  return (groups_of(direction).count() + 7) / 8 + (bits + 7) / 8;
}

inline constexpr std::size_t kSafetyShare = 40;  // bytes of every packet, each way
static_assert(bytes_of(groups_of(Direction::kDown, Class::kSafety)) <= kSafetyShare,
              "the safety groups of the car take more than their share of every packet");
static_assert(bytes_of(groups_of(Direction::kUp, Class::kSafety)) <= kSafetyShare,
              "the safety groups of the base take more than their share of every packet");
static_assert(kBodyFixed + kAckSize + state_bytes(groups_of(Direction::kDown), Direction::kDown) <=
                  kMaxBody,
              "everything that the car tells must fit into one datagram");

// Acknowledgement of the last 33 packets: the newest one, and bit k for newest - 1 - k.
struct Ack {
  std::uint16_t newest_low = 0;  // low 16 bits of the sequence
  std::uint32_t mask = 0;
  Duration hold{};  // from the arrival of the newest one to the sending of this packet
};

enum class RecordType : std::uint8_t {
  kCommand = 1,
  kCommandResult,
  kCommandResultAck,
  kEvent,
  kEventAck,
  kBulk,
  kBulkAck,
  kSchema,          // hashes of the sender's groups
  kPathProbe = 10,  // 9 is not used
  kPathProof,
  kPathReceipt  // newest packet received on one path
};
inline constexpr std::uint8_t kRecordTypeMax = 12;

struct Record {
  RecordType type;
  std::span<const std::uint8_t> payload;
};

class BodyWriter {
 public:
  // `room`: largest size of the body in bytes, <= kMaxBody.
  BodyWriter(std::span<std::uint8_t> buffer, std::size_t room, Direction direction)
      : BodyWriter(buffer, room, own_layout(direction)) {}
  // Writes by the layout of another registry; the layout outlives the writer.
  BodyWriter(std::span<std::uint8_t> buffer, std::size_t room, const Layout& layout);

  // Calls in this order: begin() once, add_ack() and add_groups() at most once, then records.
  void begin(Instant now, std::uint8_t paths_mask);
  bool add_ack(const Ack& ack);
  // Writes those of `wanted` that the layout has and that fit, in the given order; returns the set
  // of the written groups.
  GroupSet add_groups(const Snapshot& snapshot, std::span<const Group> wanted, Instant now,
                      CodecCounters& counters);
  bool add_record(RecordType type, std::span<const std::uint8_t> payload);

  // Keeps the last `bytes` of the room free until another call; written bytes are not affected.
  void hold_back(std::size_t bytes) { held_back_ = bytes; }

  std::size_t room_left() const;
  std::span<const std::uint8_t> bytes() const;
  // Bytes that a record of this payload takes.
  static std::size_t record_size(std::size_t payload) { return payload + (payload < 0xF0 ? 2 : 3); }

 private:
  FixedVector<Group, kGroups> write_set(GroupSet set);
  void write_values(std::span<const Group> groups, const Snapshot& snapshot, Instant now,
                    CodecCounters& counters);

  std::span<std::uint8_t> buffer_;
  std::size_t room_ = 0, held_back_ = 0, at_ = 0, records_ = 0;
  const Layout* layout_;
};

enum class BodyError : std::uint8_t {
  kTooShort,
  kTooLong,  // more than kMaxBody
  kBadFlags,
  kBadGroups,  // the set is empty or has a bit that the direction does not have
  kBadValue,   // a bit pattern that encodes no value
  kBadPadding,
  kBadRecord,  // unknown type, length past the end, or not in its shortest form
  kTooManyRecords
};
inline constexpr std::size_t kBodyErrors = 8;
const char* text_of(BodyError error);

struct Body {
  std::uint32_t tx_time_100us = 0;  // 24 bits
  std::uint8_t paths_mask = 0;
  std::optional<Ack> ack;
  GroupSet groups;  // without groups that are unknown here
  std::array<std::uint8_t, kGroups> age_codes{};
  Values values;                             // of the groups in the set; others unset
  FixedVector<Record, kMaxRecords> records;  // point into the bytes parsed
};

Result<Body, BodyError> parse_body(std::span<const std::uint8_t> bytes, const Layout& sender);
inline Result<Body, BodyError> parse_body(std::span<const std::uint8_t> bytes,
                                          Direction direction) {
  return parse_body(bytes, own_layout(direction));
}

// Times and path of the packet that carried a record, for the modules that take records. On the own
// clock; `sent_earliest` is the sender's time of sending minus the bound of the clock comparison:
// never too late. Empty while the clocks have not been compared.
struct Received {
  Instant at{};
  std::optional<Instant> sent_earliest;
  std::uint32_t tx_time_100us = 0;  // of the packet; times in its records are relative to it
  std::uint64_t sequence = 0;
  PathId path = 0;
};

}  // namespace pitwall::telemetry
