// A line on standard error that says how far long work on a file is, and how long it will take.
//   in     how much is done of how much, as often as it is known; whether the user asked for it
//   out    on a terminal one line that is written over and cleared at the end, at most four times a
//          second; elsewhere, where it was asked for, a line of its own once a second; otherwise
//          nothing. Work that is over within half a second says nothing on a terminal
//   units  parts are bytes; the rest of the time is that of the work so far, in proportion
//   invariants
//          without a terminal and without --progress standard error has no byte of it
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

// "reading a.log: 43 % of 2.0 GiB, 12 s left"; without the time where nothing is done yet.
std::string progress_text(std::string_view what, std::size_t done, std::size_t all, Duration spent);

// When a line is due: pure, the caller has the clock.
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
  ProgressLine(const ProgressLine&) = delete;  // the function below refers to it
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  // Empty where nothing is to be shown: then reading has nothing to do for it.
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
