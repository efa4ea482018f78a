// Writer of a chain of one-minute segments, which continues after a full disk.
//   in     records, the time; a Disk
//   out    segments as MCAP, each complete in itself: metadata, channels, then the snapshot of all
//          known values, repeated every `snapshot`, so that a reader can begin there
//          with a second Disk, an LCM event log beside each segment, under the same name
//   invariants
//          a chunk is written at 1 MiB, or earlier after half a second by the stamps or by the
//          clock: a process that is killed loses less than a second
//          a segment ends when the stamps have advanced by its length. If the disk fails, the
//          segment ends at once, records are lost and counted, and a new segment begins when the
//          disk has room again
//   errors figures(): what was lost and why; no error stops the caller
//   cost   no allocation per record, except for a new segment
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "protocol/recorder/channels.hpp"
#include "protocol/recorder/disk.hpp"
#include "protocol/recorder/lcm_segment_writer.hpp"
#include "protocol/recorder/record_queue.hpp"
#include "protocol/recording/mcap_writer.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::recorder {

struct ChainParams {
  Duration segment = seconds(60), chunk = milliseconds(500), snapshot = seconds(10);
  Duration retry = seconds(1);
  std::uint64_t room_to_resume = std::uint64_t{8} << 20U;  // free bytes needed after a failure
  recording::Metadata run{};
  ClockMap clock{};
  std::string name = "pitwall";  // of the files: NAME_UTC_NUMBER.mcap and .lcm
};

struct ChainFigures {
  std::uint64_t records = 0, bytes = 0, segments = 0;
  std::uint64_t lost = 0;           // records not written because of the disk
  std::uint64_t refused = 0;        // records that no file accepts: a program error
  std::uint64_t interruptions = 0;  // failures of the disk
  bool recording = false;
  std::string segment, problem;  // the newest
  LcmFigures lcm;                // of the logs beside the segments
};

class SegmentChain {
 public:
  // `lcm`: disk for an LCM event log beside each segment; nullptr: no LCM log.
  SegmentChain(Disk& disk, ChainParams params, Disk* lcm = nullptr);
  ~SegmentChain();  // closes the open segment

  void take(const Record& record, Instant now);
  void turn(Instant now);  // at least every 100 ms
  void close();
  ChainFigures figures() const;

 private:
  void keep(const Record& record);
  bool open(Instant stamp);
  void fail(std::string problem);
  void end_segment();
  bool flush();
  void reached_disk(std::uint64_t still_waiting);
  std::string name_of_segment(UtcTime at) const;
  void write_snapshot(Instant stamp);
  bool put(const Record& record);

  Disk& disk_;
  ChainParams params_;
  ChainFigures figures_;
  Known known_;  // with the sample times of the file
  std::unique_ptr<recording::McapWriter> writer_;
  std::optional<LcmSegmentWriter> lcm_;
  std::uint64_t waiting_ = 0;  // records of the open chunk
  std::uint64_t number_ = 0;
  std::optional<Instant> retry_at_;  // set after a failure of the disk
  Instant now_{}, segment_end_{}, snapshot_at_{}, flush_at_{};
  bool has_chunk_ = false;  // a chunk of the open segment is on the disk
};

}  // namespace pitwall::recorder
