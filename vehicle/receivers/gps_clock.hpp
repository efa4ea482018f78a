// Conversion of a receiver's GPS time to the car's clock.
//   in     per stream of one receiver: GPS time of a sample, arrival time of its bytes; in order of
//          arrival
//   out    the Instant of every GPS time, and the flaw of the stamp. A stamp without flaw is never
//          placed after its arrival
//   method offset = the smallest (arrival - GPS time) of the fastest stream in the last 8 to 16
//          seconds: transport and computing can only add delay, so the smallest value is the best.
//          A slower stream is less reliable, because all of its few samples may have been late; its
//          additional delay is learned, so that the offset stays when the fastest stream stops. The
//          remaining delay, that of the fastest message itself, is a known parameter of the
//          receiver and is subtracted.
//
//   fastest   | | | | | | | | | |                  its least delay of each half window
//   slower       |     |     |     |     |     |   used from here on, minus its additional delay
//                                        ^ kSilence after the last of the fastest
//
//          An increase of at most kJitter is followed slowly, so that the car does not appear to
//          jump; a larger one is taken at once.
//   errors a stamp that repeats or decreases is not used for the offset. Nor is one from the
//          future, until kConfirmations consecutive samples of any stream agree that the receiver's
//          time has stepped. A step to the past looks like delay and is accepted after the window
//          has passed.
//   cost   O(1); at the end of a half window O(streams)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/gnss/gps_time.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::receivers {

enum class Stream : std::uint8_t { kPosition, kVelocity, kHeading, kImu, kAttitude };
inline constexpr std::size_t kStreams = 5;

enum class StampFlaw : std::uint8_t { kNone, kFrozen, kBack, kFuture };
inline constexpr std::size_t kStampFlaws = 4;

struct Placed {
  Instant at{};
  StampFlaw flaw = StampFlaw::kNone;
};

class GpsClock {
 public:
  static constexpr Duration kSettling = seconds(1);  // the first half window
  static constexpr Duration kHalfWindow = seconds(8);
  static constexpr Duration kJitter = milliseconds(5);       // smaller changes count as delay
  static constexpr Duration kFirstStep = milliseconds(500);  // the same, while settling
  static constexpr Duration kAgreement = milliseconds(50);   // of samples that show the same step
  static constexpr int kConfirmations = 5;
  static constexpr Duration kSilence = milliseconds(500);
  static constexpr int kEnough = 5;            // samples in a half window to learn a delay
  static constexpr int kSlewPerMillion = 500;  // above the drift of clocks; 0.03 m/s at 68 m/s

  explicit GpsClock(Duration least_delay = {}) : least_delay_(least_delay) {}

  Placed place(Stream stream, gnss::GpsTime sampled, Instant arrival);

  std::uint64_t steps() const { return steps_; }  // accepted steps

 private:
  static constexpr Duration kNever{std::int64_t{1} << 62};

  struct Received {
    gnss::GpsTime last{};        // stamp
    bool ever = false;           // last is valid
    Instant at{};                // its arrival
    Duration smallest = kNever;  // smallest difference in this half window
    int samples = 0;             // of this half window
    bool learned = false;        // `slower` is valid
    Duration slower{};           // additional delay relative to the fastest stream
  };

  void begin(Duration difference, Instant arrival);
  void turn_half_window(Instant arrival);
  void learn_delays();
  bool is_suspect(Duration level);
  bool is_evidence(const Received& received, Instant arrival) const;
  void follow(Duration elapsed);

  Duration least_delay_;
  std::array<Received, kStreams> streams_{};
  std::size_t quickest_ = kStreams;  // index into streams_; kStreams: none yet
  bool started_ = false, settled_ = false;
  Duration offset_{};
  Duration current_ = kNever, previous_ = kNever;  // level of this and of the previous half window
  Instant half_began_{}, received_at_{};
  Duration suspect_{};
  int confirmations_ = 0;
  std::uint64_t steps_ = 0;
};

}  // namespace pitwall::receivers
