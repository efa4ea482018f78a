// Recording of the car: its state at 50 Hz, every frame of its bus, every datagram of its radio,
// every byte of its receivers and the other inputs of each tick, in the format of the base. The run
// can be replayed from it (hil/bench/recorded).
//   in     a folder; the inputs and outputs of each tick, the newest snapshot
//   out    segments of one minute, each with an LCM log, as protocol/recorder writes them; counters
//          for the summary
//   invariants
//          all calls except open() and json() are made by the 100 Hz loop: they copy into a bounded
//          queue without waiting or allocation. What does not fit is dropped and counted; a slow,
//          full or missing disk does not affect the loop
//   errors open(): Problem if the folder cannot be created or written; afterwards counters only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "protocol/can/frame.hpp"
#include "protocol/recorder/recorder.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/io/tick_inputs.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::io {

// What the car was set up from.
struct BlackBoxFiles {
  std::string car = {};
  std::string car_text = {};          // with that of the files that it is like
  std::string track = {}, bank = {};  // no bank: empty
};

class BlackBox {
 public:
  static constexpr std::uint64_t kStateEvery = 2;                     // ticks
  static constexpr const char *kBaseKey = "base", *kNoBase = "none";  // metadata key and value

  // With an empty folder the recording is off. The files are named in the recording; `no_base` is
  // stored in it: no base station is used.
  static Result<BlackBox, Problem> open(const std::string& folder, const BlackBoxFiles& files,
                                        bool no_base = false);

  bool on() const { return recorder_ != nullptr; }
  bool state_due(std::uint64_t tick) const { return on() && tick % kStateEvery == 0; }
  // Inputs and sent frames of a tick; to be called after receiver() of the same tick.
  void tick(const pipeline::Inputs& in, std::span<const can::Frame> sent);
  void state(const telemetry::Snapshot& state, Instant now);
  // `down`: from the car to its base.
  void radio(bool down, Instant at, const recorder::RadioDatagram& datagram);
  void event(std::string_view text, Instant at);  // plain ASCII without quotes
  void receiver(std::size_t unit, Instant at, std::span<const std::uint8_t> bytes);
  // Counters as JSON; not for the loop.
  std::string json() const;

 private:
  std::unique_ptr<recorder::Recorder> recorder_;
  TickCounts counts_;  // in this tick
};

}  // namespace pitwall::io
