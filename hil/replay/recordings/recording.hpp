// Recording of CAN and sensor traffic as a value: its sources, its records in total order, and what
// a reader left out, with the place.
//   out    records ordered by (stamp, source, sequence); the order is the same for every reader and
//          every run
//   units  stamps: nanoseconds on the calendar clock of the recording
//   invariants
//          the sequences of a source count from 0 in the order of the file; `first` and `last` of a
//          source are its earliest and latest stamp
//          a record of a CAN source holds a frame, every other record bytes; the recording owns the
//          bytes
//          everything that a reader leaves out is counted and described in a remark
//   cost   some 100 bytes for a record beside the bytes of the file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "hil/replay/recordings/byte_pool.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::traffic {

enum class SourceKind : std::uint8_t {
  kCan,       // frames of a bus
  kReceiver,  // bytes of a GNSS or inertial receiver, as received
  kRos,       // ROS 2 messages: encapsulated CDR of the type that the source names
  kOther,     // bytes in another encoding: datagrams, JSON, LCM messages
};
std::string_view to_string(SourceKind kind);

struct Source {
  std::string name;  // "can0", "/gnss/0", "/vehicle/imu"
  SourceKind kind = SourceKind::kOther;
  std::string type;  // "novatel", "sensor_msgs/msg/Imu", "json"
  std::uint64_t records = 0;
  std::uint64_t backward = 0;  // records with a stamp before that of the previous one in the file
  UtcTime first{}, last{};

  bool operator==(const Source&) const = default;
};

struct Record {
  UtcTime at;
  std::uint32_t source = 0;  // index in Recording::sources
  std::uint64_t sequence = 0;
  std::variant<Bytes, can::Frame> content;

  const can::Frame* frame() const { return std::get_if<can::Frame>(&content); }
  Bytes bytes() const { return frame() == nullptr ? std::get<Bytes>(content) : Bytes{}; }
};

inline bool precedes(const Record& a, const Record& b) {
  return std::tuple{a.at.ns, a.source, a.sequence} < std::tuple{b.at.ns, b.source, b.sequence};
}

struct RecordingCounters {
  std::uint64_t refused = 0;       // messages left out: type, stamp or format is wrong
  std::uint64_t error_frames = 0;  // CAN error frames, left out because they are not traffic
  std::uint64_t unverified = 0;    // records without a checksum that could be checked
  std::uint64_t lost_blocks = 0;   // chunks or pages of the file that could not be read
  std::uint64_t lost_bytes = 0;    // bytes of the file that are in no record

  bool operator==(const RecordingCounters&) const = default;
};

// Remark of a reader: the first place, what happened there, and how often it happened.
struct Remark {
  std::string place;  // "run.mcap: byte 4711"
  std::string what;
  std::uint64_t times = 1;

  bool operator==(const Remark&) const = default;
};
std::string to_string(const Remark& remark);

struct Recording {
  std::vector<Source> sources;
  std::vector<Record> records;
  RecordingCounters counters;
  std::vector<Remark> remarks;
  BytePool pool;  // memory that holds the bytes of the records

  // Stamp of the first and of the last record; zero without records.
  UtcTime first() const { return records.empty() ? UtcTime{} : records.front().at; }
  UtcTime last() const { return records.empty() ? UtcTime{} : records.back().at; }
};

}  // namespace pitwall::traffic
