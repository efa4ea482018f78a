// The car's own recording: its state at 50 Hz, every frame of its bus, every datagram of its radio,
// every byte of its receivers and what else each tick was given, in the base's format: the run can
// be driven again of it (hil/bench/recorded).
//   in     a folder; what is heard and said in each tick, the newest snapshot
//   out    segments of a minute with an LCM log beside each, as protocol/recorder makes them;
//          counters for the summary
//   invariants
//          all calls but open() and json() belong to the 100 Hz loop: they copy into a bounded
//          queue and neither wait nor allocate. What does not fit is dropped and counted; a disk
//          that is slow, full or gone does not touch the loop
//   errors open(): Problem where the folder cannot be made or written; afterwards figures only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "protocol/can/frame.hpp"
#include "protocol/recorder/recorder.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/io/tick_inputs.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::io {

class BlackBox {
 public:
  static constexpr std::uint64_t kStateEvery = 2;                     // ticks
  static constexpr const char *kBaseKey = "base", *kNoBase = "none";  // of the metadata

  // An empty folder: it is off. `car_file` and `track_file` are named in the recording.
  // `no_base`: none is watched, and the recording says so.
  static Result<BlackBox, Problem> open(const std::string& folder, const std::string& car_file,
                                        const std::string& track_file, bool no_base = false);

  bool on() const { return recorder_ != nullptr; }
  bool state_due(std::uint64_t tick) const { return on() && tick % kStateEvery == 0; }
  // What the tick was given and what it said; after the receivers' bytes of the same tick.
  void tick(const pipeline::Inputs& in, std::span<const can::Frame> sent);
  void state(const telemetry::Snapshot& state, Instant now);
  // `down`: from the car to its base.
  void radio(bool down, Instant at, const recorder::RadioDatagram& datagram);
  void event(std::string_view text, Instant at);  // plain ASCII without quotes
  void receiver(std::size_t unit, Instant at, std::span<const std::uint8_t> bytes);
  // Counters; not for the loop.
  std::string json() const;

 private:
  std::unique_ptr<recorder::Recorder> recorder_;
  TickCounts counts_;  // of this tick
};

}  // namespace pitwall::io
