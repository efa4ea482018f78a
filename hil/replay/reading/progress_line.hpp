// Progress line on standard error for long work on a file, with the remaining time.
//   in     the done and the total amount, as often as they are known; whether the user asked for it
//   out    on a terminal one line that is overwritten and cleared at the end, at most four times a
//          second; elsewhere, if the user asked for it, a new line once a second; otherwise
//          nothing. On a terminal nothing is shown for work shorter than half a second
//   units  amounts are bytes; the remaining time is extrapolated from the time so far
//   invariants
//          without a terminal and without --progress nothing is written to standard error
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "hil/replay/formats/log_watch.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::replay {

inline constexpr const char* kProgressHelp =
    "say how far it is once a second, also where standard error is no terminal";

// "reading a.log: 43 % of 2.0 GiB, 12 s left"; without the time if nothing is done yet.
std::string progress_text(std::string_view what, std::size_t done, std::size_t all, Duration spent);

// Decides when a line is due. Pure: the caller has the clock.
class ProgressPace {
 public:
  ProgressPace(Duration silence, Duration pause) : silence_(silence), pause_(pause) {}
  bool is_due(Duration spent);

 private:
  Duration silence_, pause_;
  std::optional<Duration> last_;
};

class ProgressLine {
 public:
  using Clock = std::function<Instant()>;
  ProgressLine(std::string what, bool is_asked_for);
  ProgressLine(std::string what, bool is_asked_for, Clock clock);
  ProgressLine(const ProgressLine&) = delete;  // the result of function() refers to it
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  // The progress function; empty if nothing is to be shown, so that reading has no extra cost.
  ReadProgress function();

 private:
  void show(std::size_t done, std::size_t all);

  std::string what_;
  bool is_terminal_ = false, is_asked_for_ = false, is_shown_ = false;
  Clock clock_;
  Instant begin_;
  ProgressPace pace_;
};

}  // namespace pitwall::replay
