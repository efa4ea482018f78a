// Writer of the LCM event log beside a segment: the same records under the same name, for LCM's own
// tools.
//   in     the records of an open segment
//   out    NAME.lcm: one event per record, with the channel name of the segment and the time of
//          reception. Types: `pitwall-base export lcm`. The snapshot of all known values and the
//          tick records are left out; the groups have the values of the snapshot
//   invariants
//          the segment does not depend on it: if the disk fails, this log ends after a whole event,
//          and the next segment begins a new one
//   errors figures()
//   cost   no allocation per record once its buffers have grown
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/recorder/disk.hpp"
#include "protocol/recorder/lcm_encoder.hpp"
#include "protocol/recorder/record_queue.hpp"
#include "protocol/recording/lcm_log.hpp"

namespace pitwall::recorder {

struct LcmFigures {
  std::uint64_t events = 0, bytes = 0;
  std::uint64_t lost = 0;  // events that could not be written
};

class LcmSegmentWriter {
 public:
  LcmSegmentWriter(Disk& disk, const ClockMap& clock);

  void begin(const std::string& name);  // without .lcm
  void take(const Record& record);
  void flush();
  void end(bool keep);
  const LcmFigures& figures() const { return figures_; }

 private:
  Disk& disk_;
  LcmEncoder encoder_;
  std::optional<recording::LcmLogWriter> log_;
  std::vector<std::uint8_t> event_, waiting_;
  std::uint64_t waiting_events_ = 0;
  LcmFigures figures_;
};

}  // namespace pitwall::recorder
