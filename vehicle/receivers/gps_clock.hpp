// The car's clock in terms of a receiver's: which Instant was this GPS time?
//   in     per stream of one receiver: GPS time of a sample, when its bytes arrived; in order of
//          arrival
//   out    the Instant of every GPS time, and what is wrong with the stamp itself. A stamp without
//          flaw is never placed after its arrival
//   method offset = the smallest (arrival - GPS time) of the quickest stream in the last 8 to 16
//          seconds: transport and computing can only add delay, so the smallest is the truest. A
//          slower stream says less: a few of its samples may all have been late. How much slower
//          each one is is learned meanwhile, so that the offset stays when the quickest falls
//          silent. What is left is the delay of the quickest message itself: it is known of the
//          receiver and taken out.
//
//   quickest  | | | | | | | | | |                  its least delay of each half window
//   slower       |     |     |     |     |     |   counts from here on, less what it is slower
//                                        ^ kSilence after the last of the quickest
//
//          An offset that grows does so slowly: the car shall not seem to jump along its way.
//   errors a stamp that stands still or runs back is evidence of nothing. One from the future is
//          not either, until kConfirmations samples in a row, of whatever stream, agree that the
//          receiver's time was stepped; a step to the past looks like delay and is believed when
//          the window has passed.
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
  static constexpr Duration kJitter = milliseconds(5);       // less is delay that got smaller
  static constexpr Duration kFirstStep = milliseconds(500);  // likewise, while settling
  static constexpr Duration kAgreement = milliseconds(50);   // of samples that tell of one step
  static constexpr int kConfirmations = 5;
  static constexpr Duration kSilence = milliseconds(500);
  static constexpr int kEnough = 5;            // samples of a half window, to learn a delay from
  static constexpr int kSlewPerMillion = 500;  // more than clocks drift; 0.03 m/s at 68 m/s

  explicit GpsClock(Duration least_delay = {}) : least_delay_(least_delay) {}

  Placed place(Stream stream, gnss::GpsTime sampled, Instant arrival);

  std::uint64_t steps() const { return steps_; }  // believed ones

 private:
  static constexpr Duration kNever{std::int64_t{1} << 62};

  struct Received {
    gnss::GpsTime last{};        // stamp
    bool ever = false;           // last is one
    Instant at{};                // when it came
    Duration smallest = kNever;  // difference of this half window
    int samples = 0;             // of this half window
    bool learned = false;        // how much
    Duration slower{};           // it is than the quickest stream
  };

  void begin(Duration difference, Instant arrival);
  void turn_half_window(Instant arrival);
  void learn_delays();
  bool is_suspect(Duration level);
  bool is_evidence(const Received& received, Instant arrival) const;
  void follow(Duration elapsed);

  Duration least_delay_;
  std::array<Received, kStreams> streams_{};
  std::size_t quickest_ = kStreams;  // of streams_; none is known yet
  bool started_ = false, settled_ = false;
  Duration offset_{};
  Duration current_ = kNever, previous_ = kNever;  // level of this half window, of the one before
  Instant half_began_{}, received_at_{};
  Duration suspect_{};
  int confirmations_ = 0;
  std::uint64_t steps_ = 0;
};

}  // namespace pitwall::receivers
