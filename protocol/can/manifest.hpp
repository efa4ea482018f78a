// Manifest of a database: what DBC cannot express about a message (direction, period, timeout,
// counter, checksum, safety class, plausible rates of change). One YAML file beside each DBC file.
//   in      the YAML text and the database that it belongs to
//   out     the manifest; rows that join it with the database, one per message
//   errors  a Problem at "file:line:column": unknown message or signal, a message of the database
//           without an entry, a counter that is not a plain unsigned field, a timeout shorter than
//           the period, a rate that is not positive, an ignored id that belongs to a message, a
//           checksum whose profile does not fit its signals, counter, data ids or length
//
//   checksum: {profile: sae_j1850, signal: crc}
//   checksum: {profile: e2e_p01, signal: crc, data_id: 0x123, data_id_mode: both}
//             data_id_mode: both, alternating, low, or nibble with data_id_nibble: SIGNAL
//   checksum: {profile: e2e_p02, signal: crc, data_ids: [16 numbers]}
//   checksum: {profile: e2e_p05, signal: crc, data_id: 0x123}
// The counter of profiles 1, 2 and 5 is the message's `counter`. Bit positions are those of the
// profiles, except that the header of profiles 2 and 5 may start at any byte, and that the fields
// of profile 1 may be anywhere.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/can/database.hpp"
#include "protocol/can/e2e.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::can {

// Seen from the computer: kFromCar is from drive-by-wire and race control, kToCar to drive-by-wire.
enum class Direction : std::uint8_t { kFromCar, kToCar };
// kActuator moves the car: it is sent only while armed, and the frame gate checks it.
enum class SafetyClass : std::uint8_t { kInformation, kStatus, kActuator, kRaceControl };

// Row of the generated message table.
struct MessageRow {
  std::uint32_t id;
  std::uint8_t length;
  const char* name;
  Direction direction;
  SafetyClass safety;
  bool required;  // true: a bus without it is not the bus of this database
  Duration period;
  Duration timeout;
  bool has_counter;
  std::uint8_t counter_start;  // bit position, Intel
  std::uint8_t counter_bits;
  ProtectionRule protection{};
};

// Fastest change that the physics of a signal allows, in its DBC unit per second.
struct SlewRow {
  std::uint32_t id;
  const char* signal;
  double max_per_s;
};

// Range of ids, both ends included, that other nodes use on this bus; the computer ignores them.
struct IdRange {
  std::uint32_t first = 0, last = 0;
};

struct ManifestSlew {
  std::string signal;
  double max_per_s = 0.0;
  std::string place;
};

struct ManifestChecksum {
  Protection profile = Protection::kNone;
  DataIdMode data_id_mode = DataIdMode::kBoth;
  std::string signal, nibble;  // nibble: only with DataIdMode::kNibble, else empty
  std::uint16_t data_id = 0;
  std::array<std::uint8_t, 16> data_ids{};
  std::string place, signal_place, nibble_place, data_id_place;
};

struct ManifestMessage {
  std::string name;
  Direction direction = Direction::kFromCar;
  SafetyClass safety = SafetyClass::kInformation;
  bool required = true;  // from_car only
  Duration period{}, timeout{};
  std::string counter;  // empty: none
  ManifestChecksum checksum;
  std::vector<ManifestSlew> slews;
  std::string place, counter_place;
};

struct Manifest {
  std::string name;
  std::string database;  // file name of the DBC
  std::string revision;  // of the car's CAN bus, e.g. "CAN1-INDY-V14"
  std::vector<IdRange> ignored;
  std::string ignored_place;
  std::vector<ManifestMessage> messages;

  const ManifestMessage* find(std::string_view message) const;
};

Result<Manifest, Problem> parse_manifest(std::string_view text, const std::string& name);

// The first place where manifest and database contradict each other; nullopt if there is none.
std::optional<Problem> contradiction(const Manifest& manifest, const Database& database);

// One row per message of the database, in its order. The two must not contradict each other. The
// rows point to the names in the database, which must outlive them.
std::vector<MessageRow> rows(const Manifest& manifest, const Database& database);

}  // namespace pitwall::can
