// SPDX-License-Identifier: Apache-2.0
// Any bytes are a log or an error with a place, by the reader that their beginning asks for; a log
// that is written again reads the same; what can be played is played whole, in virtual time,
// without a step back.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "hil/replay/formats/candump.hpp"
#include "hil/replay/formats/log_reader.hpp"
#include "hil/replay/player.hpp"
#include "hil/replay/timeline.hpp"
#include "hil/replay/writers/candump_writer.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

using namespace pitwall;
using namespace pitwall::replay;

struct VirtualRim {
  Instant time{};
  std::uint64_t sent = 0;

  Instant now() const { return time; }
  void wait_until(Instant deadline) {
    CHECK(deadline > time);
    time = deadline;
  }
  TrackOutcome send(std::size_t, std::size_t, std::size_t count) {
    sent += count;
    return {.taken = count};
  }
  static bool stopped() { return false; }
};

void check_round_trip(const CanLog& log) {
  const auto again = read_candump(to_candump(log), "again");
  CHECK(again.has_value() && again->frames.size() == log.frames.size());
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    LoggedFrame read = again->frames[i];
    CHECK(again->channels[read.channel] == log.channels[log.frames[i].channel]);
    read.channel = log.frames[i].channel;  // channels of skipped lines shift the numbers
    CHECK(read == log.frames[i]);
  }
}

void play(const CanLog& log, const TimelineOptions& options, LatePolicy late) {
  const auto timeline = make_timeline(log, options);
  if (!timeline) {
    CHECK(!timeline.error().what.empty());
    return;
  }
  std::uint64_t frames = 0;
  for (const Track& track : timeline->tracks) {
    CHECK(!track.frames.empty() && track.due.size() == track.frames.size());
    for (std::size_t i = 1; i < track.due.size(); ++i) CHECK(track.due[i] >= track.due[i - 1]);
    CHECK(track.due.front() >= Duration{} && track.due.back() <= timeline->pass);
    frames += track.frames.size();
  }
  CHECK(frames == timeline->frames);
  VirtualRim rim;
  const PlayReport report = Player(*timeline, {.passes = 2, .late = late}, rim).play({});
  CHECK(report.frames.sent == 2 * frames && rim.sent == report.frames.sent &&
        report.dropped() == 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text{reinterpret_cast<const char*>(bytes), size};
  const auto log = read_can_log(text, "f.log");
  if (!log) {
    CHECK(log.error().place.starts_with("f.log") && !log.error().what.empty());
    return 0;
  }
  CHECK(log->remarks.size() + log->remarks_left_off ==
        log->counters.bad_records + log->counters.cut_tails);
  check_round_trip(*log);
  play(*log, {}, LatePolicy::kCatchUp);
  play(*log, {.speed = 1e-3, .interface = "v", .longest_gap = seconds(5)}, LatePolicy::kDrop);
  play(*log, {.speed = 1e6, .interface = "v", .start = milliseconds(1)}, LatePolicy::kAbort);
  return 0;
}
