// Progress messages of a run: one JSON object per line.
//   plan    once, before the first tick: scenario, seed, duration, planned events, expectations
//   at      every kEvery of scenario time: speed, mode, flag, laps, cross-track error by bracket,
//           state of each expectation, reactions
//   event   as it happens: begin or end of a fault, flag, mode, lap, action on a process, contact
//   result  once, at the end: the whole RunResult; or failure, with the reason
//   in      the run at each tick, in order of time; its result or the problem that ended it
//   invariants
//           the lines of a lockstep run are the same for the same scenario, build and seed, except
//           for the wall time in the result. An unknown value is null
//   bound   kEventsMax events; the line after them gives the number of omitted ones
//   units   as in the names; times in seconds of scenario time
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hil/bench/result.hpp"
#include "hil/bench/rig.hpp"
#include "hil/grading/grader.hpp"
#include "hil/grading/reaction.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench {

// State of a run at one tick.
struct RunView {
  Instant now{};
  const Rig& rig;
  double mode = kUnset;  // of the car's supervisor
  const grading::Grader& grader;
  const RunResult& result;  // so far
};
using Follow = std::function<void(const RunView&)>;

class Progress {
 public:
  using Print = std::function<void(const std::string& line)>;
  static constexpr Duration kEvery = milliseconds(500);
  static constexpr std::size_t kEventsMax = 2'000;

  Progress(const scenario::Scenario& scenario, std::string_view mode, Print print);

  void observe(const RunView& run);
  void ended(const RunResult& result);
  void failed(const Problem& problem);

 private:
  struct Planned {
    Instant at{};
    std::string_view kind;
    std::string text;
  };

  void plan_events();
  void print_plan(std::string_view mode);
  void print_state(const RunView& run);
  void print_event(Instant at, std::string_view kind, const std::string& text);
  void note_changes(const RunView& run);

  scenario::Scenario scenario_;
  Print print_;
  grading::ReactionMonitor reactions_;
  std::vector<Planned> planned_;  // in order of time
  std::size_t next_planned_ = 0, actions_published_ = 0, events_ = 0;
  Instant due_{};
  race::Flags flags_;
  double mode_ = kUnset;
  std::uint32_t laps_ = 0;
};

}  // namespace pitwall::bench
