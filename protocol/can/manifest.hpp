// Manifest of a database: what DBC cannot express about a message (direction, period, timeout,
// counter, checksum, safety class, plausible rates of change). One YAML file beside each DBC file.
//   in      the YAML text and the database that it belongs to
//   out     the manifest; and rows that join it with the database, one per message
//   errors  a Problem at "file:line:column": unknown message or signal, a message of the database
//           without an entry, a counter that is not a plain unsigned field, a timeout shorter than
//           the period, a rate that is not positive, an ignored id that a message has, a checksum
//           whose profile does not fit its signals, counter, data ids or length
//
//   checksum: {profile: sae_j1850, signal: crc}
//   checksum: {profile: e2e_p01, signal: crc, data_id: 0x123, data_id_mode: both}
//             data_id_mode: both, alternating, low, or nibble with data_id_nibble: its signal
//   checksum: {profile: e2e_p02, signal: crc, data_ids: [16 numbers]}
//   checksum: {profile: e2e_p05, signal: crc, data_id: 0x123}
// The counter of profiles 1, 2 and 5 is the message's `counter`. Places are those of the profiles,
// except that the header of profiles 2 and 5 may stand at any byte and the fields of 1 anywhere.
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

// Seen from the computer: from drive-by-wire and race control to it, or from it to drive-by-wire.
enum class Direction : std::uint8_t { kFromCar, kToCar };
// kActuator moves the car: only while armed, and judged by the frame gate.
enum class SafetyClass : std::uint8_t { kInformation, kStatus, kActuator, kRaceControl };

// One line of the generated table.
struct MessageRow {
  std::uint32_t id;
  std::uint8_t length;
  const char* name;
  Direction direction;
  SafetyClass safety;
  bool required;  // a bus without it is not the bus that the database describes
  Duration period;
  Duration timeout;
  bool has_counter;
  std::uint8_t counter_start;  // bit position, Intel
  std::uint8_t counter_bits;
  ProtectionRule protection{};
};

// The fastest change that the physics behind a signal can make, in its DBC unit per second.
struct SlewRow {
  std::uint32_t id;
  const char* signal;
  double max_per_s;
};

// Ids, both ends included, that other nodes may use on this bus: no business of the computer.
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
  std::string signal, nibble;  // nibble: empty but with DataIdMode::kNibble
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

// Nothing, or the first place where manifest and database contradict each other.
std::optional<Problem> contradiction(const Manifest& manifest, const Database& database);

// One row per message of the database, in its order. The two must not contradict each other, and
// the database must outlive the rows, whose names are its own.
std::vector<MessageRow> rows(const Manifest& manifest, const Database& database);

}  // namespace pitwall::can
