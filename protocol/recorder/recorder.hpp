// Recorder of all traffic, in both directions, into a folder of MCAP segments and LCM event logs.
//   in     states, events, texts, datagrams as they occur, each with its time
//   out    files, see segment_chain.hpp; figures
//   invariants
//          no call waits for the disk or for another thread, see record_queue.hpp. All calls except
//          figures() are by one thread. One thread writes; others sync the files every second. A
//          base that is killed loses less than the last second
//   bound  at most kQueueBytes are queued; records beyond are dropped and counted
//   errors start(): Problem if the folder cannot be created or written. Later: figures(). A full
//          disk stops nothing, and the recording continues when there is room again
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "protocol/can/frame.hpp"
#include "protocol/recorder/file_disk.hpp"
#include "protocol/recorder/raw_record.hpp"
#include "protocol/recorder/segment_chain.hpp"
#include "protocol/recorder/tick_record.hpp"
#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::recorder {

inline constexpr std::size_t kQueueBytes = std::size_t{4} << 20;  // about ten seconds

struct RecorderFigures {
  ChainFigures chain;
  std::uint64_t dropped = 0;   // records that did not fit into the queue
  std::uint64_t left_out = 0;  // raw records beyond the budget of bytes
  std::uint64_t syncs = 0, failed_syncs = 0;
  Duration longest_sync{};
  std::uint64_t free_bytes = 0;
  double bytes_per_s = 0.0;     // since the start
  double minutes_left() const;  // NaN if unknown
  std::uint64_t lost() const { return chain.lost + dropped + left_out; }
  std::uint64_t bytes() const { return chain.bytes + chain.lcm.bytes; }
};

class Recorder {
 public:
  // `run`: further metadata of each segment, in addition to clock and number.
  static Result<std::unique_ptr<Recorder>, Problem> start(const std::string& folder,
                                                          recording::Metadata run);
  ~Recorder();

  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups, Instant received);
  void text(Topic topic, Instant at, std::string_view json);
  // Raw bytes have a byte budget, so that a flood on the radio leaves room on the disk and in the
  // queue for everything else; records beyond it are left out and counted.
  static constexpr double kRawBytesPerSecond = 1e6, kRawBurstBytes = 2e6;
  void datagram(bool down, Instant at, const RadioDatagram& datagram);
  void receiver(std::size_t unit, Instant at, std::span<const std::uint8_t> bytes);
  void can(bool out, Instant at, const can::Frame& frame);
  void tick(Instant at, const TickRecord& tick);
  RecorderFigures figures() const;
  const ClockMap& clock() const { return clock_; }

 private:
  Recorder(const std::string& folder, recording::Metadata run, ClockMap clock);
  void write_all();
  void raw(std::uint16_t channel, Instant at, std::span<const std::uint8_t> bytes);

  ClockMap clock_;
  Instant started_;
  FileDisk disk_, lcm_disk_;
  SegmentChain chain_;
  RecordQueue queue_{kQueueBytes};
  double raw_room_bytes_ = kRawBurstBytes;
  Instant raw_at_{};
  std::atomic<std::uint64_t> left_out_ = 0;
  mutable std::mutex mutex_;
  ChainFigures reported_;  // figures after the writer's last batch
  std::thread writer_;
};

// Metadata of the writing program: program, revision, schema; and of a file it was started with:
// name and, if it can be read, SHA-256; or that of the text that was read from it.
recording::Metadata program_metadata(const std::string& program);
void append_file(recording::Metadata& run, const std::string& key, const std::string& path);
void append_text(recording::Metadata& run, const std::string& key, const std::string& path,
                 const std::string& text);
// The clock of this process and machine.
ClockMap clock_now();
// {"type":"recorder",...}
std::string json_of(const RecorderFigures& figures, Instant now);

}  // namespace pitwall::recorder
