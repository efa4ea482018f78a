// Player of a recording as if it were live: the same states and texts, at a chosen speed.
//   in     a folder of segments; how much time has passed; speed and jumps
//   out    calls of a Listener; the time of the recording
//   units  Instants on the clock of the base that recorded, as in the first segment; speed is
//          recorded seconds per second, from -20 to 20; a magnitude below 0.1 counts as 0.1;
//          0: pause
//   invariants
//          played forward, every message is given once and in order. After a jump the Listener has
//          what the live base had at that time; playing backwards is a series of jumps
//          it cannot send anything: there is no uplink
//   errors open(): Problem if no segment can be read. Damaged segments are read as far as possible;
//          problems() lists them
//   cost   holds one segment and the texts of the recording in memory
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "basestation/replay/listener.hpp"
#include "basestation/replay/segment_reader.hpp"
#include "protocol/recorder/channels.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

inline constexpr double kSlowest = 0.1, kFastest = 20.0;

class Player {
 public:
  // `index`: gets every state of the recording, oldest first; nullptr: nobody.
  static Result<Player, Problem> open(const std::string& folder, Listener* index = nullptr);

  Instant begin() const { return begin_; }
  Instant end() const { return end_; }
  Instant now() const { return now_; }
  bool ended() const { return now_ >= end_; }
  double speed() const { return speed_; }
  const recorder::ClockMap& clock() const { return clock_; }
  const recording::Metadata& run() const { return run_; }  // of the first segment
  const std::vector<std::string>& problems() const { return problems_; }

  void set_speed(double speed);  // NaN: unchanged
  void jump(Instant to, Listener& listener);
  // `passed`: elapsed time of the viewer.
  void advance(Duration passed, Listener& listener);

 private:
  struct Segment {
    std::string path;
    Instant begin{}, end{};
  };
  struct Text {
    recorder::Topic topic;
    Instant at{};
    std::string json;
  };

  bool add(const std::string& path, Listener* index);
  void load(std::size_t segment);
  void tell_texts_until(Instant to, Listener& listener);
  void tell_until(Instant to, Listener& listener);

  recorder::ClockMap clock_;
  recording::Metadata run_;
  std::vector<Segment> segments_;
  std::vector<Text> texts_;  // without the frequent ones, which a jump does not repeat
  std::vector<std::string> problems_;
  Instant begin_{}, end_{}, now_{};
  double speed_ = 1.0;
  Duration behind_{};  // played backwards: time not shown yet
  std::size_t current_ = 0;
  // On the heap, so that their addresses survive a move of the player.
  std::unique_ptr<std::string> file_ = std::make_unique<std::string>();
  std::unique_ptr<telemetry::Snapshot> known_ = std::make_unique<telemetry::Snapshot>();
  std::unique_ptr<SegmentReader> reader_;
};

}  // namespace pitwall::replay
