// Writer of a chain of one-minute segments, which continues after a full disk.
//   in     records, the time now; a Disk
//   out    segments as MCAP, each whole in itself: metadata, channels, then the picture as it was
//          known; again every kPictureEvery, so that a reader can begin there
//          where there is a disk for it, an LCM event log beside each, under the same name
//   invariants
//          a chunk is handed to the disk after half a second of stamps or of time, whichever is
//          first, or at 1 MiB: a process that is killed loses less than a second
//          a segment ends when stamps have gone on by its length. When the disk fails, the segment
//          ends as it is, records are lost and counted, and a new segment begins when the disk
//          has room again
//   errors figures(): what was lost and why; nothing here stops the caller
//   cost   no allocation at a record, but for a new segment
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "protocol/recorder/channels.hpp"
#include "protocol/recorder/disk.hpp"
#include "protocol/recorder/lcm_twin.hpp"
#include "protocol/recorder/record_queue.hpp"
#include "protocol/recording/mcap_writer.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::recorder {

struct ChainParams {
  Duration segment = seconds(60), chunk = milliseconds(500), picture = seconds(10);
  Duration retry = seconds(1);
  std::uint64_t room_to_resume = std::uint64_t{8} << 20U;  // bytes that must be free
  recording::Metadata run{};
  ClockMap clock{};
  std::string name = "pitwall";  // of the files: NAME_UTC_NUMBER.mcap and .lcm
};

struct ChainFigures {
  std::uint64_t records = 0, bytes = 0, segments = 0;
  std::uint64_t lost = 0;           // records that came while the disk took none
  std::uint64_t refused = 0;        // records that no file takes: their number is our mistake
  std::uint64_t interruptions = 0;  // times that the disk failed
  bool recording = false;
  std::string segment, problem;  // the newest
  LcmFigures lcm;                // of the logs beside the segments
};

class SegmentChain {
 public:
  // `lcm`: takes an LCM event log beside each segment; nullptr: none.
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
  void put_picture(Instant stamp);
  bool put(const Record& record);

  Disk& disk_;
  ChainParams params_;
  ChainFigures figures_;
  Known known_;  // sample times as in the file
  std::unique_ptr<recording::McapWriter> writer_;
  std::optional<LcmTwin> lcm_;
  std::uint64_t waiting_ = 0;  // records of the open chunk
  std::uint64_t number_ = 0;
  std::optional<Instant> retry_at_;  // the disk has failed
  Instant now_{}, segment_end_{}, picture_at_{}, flush_at_{};
  bool has_chunk_ = false;  // the open segment, on the disk
};

}  // namespace pitwall::recorder
