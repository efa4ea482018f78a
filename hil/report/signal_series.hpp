// Signals of a CAN log as lines over time, decoded by a database.
//   in     frames of a log in any order; signals of a database, which must outlive the series; the
//          part of the log to read
//   out    one series per signal, or per signal and channel if its message is on several channels;
//          sorted by time; counters of the frames that give no point
//   units  seconds from the earliest frame of the log; values in the unit of the signal
//   invariants
//          a multiplexed signal has points only where it is present. A pause longer than
//          kGapPeriods mean periods of a series is a gap in its line
//   errors none: a signal that does not occur has a series without points
//   cost   O(frames * signals)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hil/replay/formats/can_log.hpp"
#include "hil/report/series.hpp"
#include "protocol/can/database.hpp"

namespace pitwall::report {

inline constexpr double kGapPeriods = 5.0;
// A 64-bit field with foreign content can decode to any double; larger values are not drawn.
inline constexpr double kMaxDrawn = 1e100;

struct ChosenSignal {
  const can::Message* message = nullptr;
  const can::Signal* signal = nullptr;

  std::string name() const { return message->name + "." + signal->name; }
};

struct LogPart {
  double from_s = 0.0, to_s = 0.0;
  std::string channel{};  // empty: every channel
};

struct SignalSeries {
  ChosenSignal chosen;
  std::string channel;  // empty: only one channel has the message
  Line points;          // y NaN: a gap
  std::uint64_t values = 0;
  std::uint64_t other_frames = 0;  // with its identifier, but with another length or kind
  std::uint64_t absent = 0;        // frames in which the multiplexer excludes the signal
  std::uint64_t not_drawn = 0;     // values that are not finite or beyond kMaxDrawn

  std::string name() const {
    return channel.empty() ? chosen.name() : chosen.name() + " (" + channel + ")";
  }
};

struct LogSpan {
  UtcTime begin;
  double length_s = 0.0;
};

// From the earliest to the latest frame of the log; zero without frames.
LogSpan span_of(const replay::CanLog& log);

std::vector<SignalSeries> signal_series(const replay::CanLog& log,
                                        std::span<const ChosenSignal> chosen, const LogPart& part);

}  // namespace pitwall::report
