// Player of a recording as if it were live: the same picture, the same texts, at the pace that is
// asked for.
//   in     a folder of segments; how much time has passed; speed and jumps
//   out    calls of a Listener; the time of the recording
//   units  Instants on the clock of the base that recorded, as the first segment has it; speed is
//          recorded seconds per second, from -20 to 20, slower than 0.1 either way is 0.1; 0: pause
//   invariants
//          played forward, everything is told once and in order. After a jump the Listener knows
//          what the live base knew at that time: backwards is a row of jumps
//          nothing here can send anything: there is no uplink
//   errors open(): Problem where there is no segment that can be read. Damaged segments are read as
//          far as they go; problems() tells them
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
  static Result<Player, Problem> open(const std::string& folder);

  Instant begin() const { return begin_; }
  Instant end() const { return end_; }
  Instant now() const { return now_; }
  bool ended() const { return now_ >= end_; }
  double speed() const { return speed_; }
  const recorder::ClockMap& clock() const { return clock_; }
  const recording::Metadata& run() const { return run_; }  // of the first segment
  const std::vector<std::string>& problems() const { return problems_; }

  void set_speed(double speed);  // no number: as it was
  void jump(Instant to, Listener& listener);
  // So much time has passed where somebody watches.
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

  bool add(const std::string& path);
  void load(std::size_t segment);
  void tell_texts_until(Instant to, Listener& listener);
  void tell_until(Instant to, Listener& listener);

  recorder::ClockMap clock_;
  recording::Metadata run_;
  std::vector<Segment> segments_;
  std::vector<Text> texts_;  // but those that are told again and again
  std::vector<std::string> problems_;
  Instant begin_{}, end_{}, now_{};
  double speed_ = 1.0;
  Duration behind_{};  // played backwards: not yet shown
  std::size_t current_ = 0;
  // Stay where they are when the player is moved.
  std::unique_ptr<std::string> file_ = std::make_unique<std::string>();
  std::unique_ptr<telemetry::Snapshot> known_ = std::make_unique<telemetry::Snapshot>();
  std::unique_ptr<SegmentReader> reader_;
};

}  // namespace pitwall::replay
