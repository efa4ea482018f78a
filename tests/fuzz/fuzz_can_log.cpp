// SPDX-License-Identifier: Apache-2.0
// Any bytes are a log or an error with a place; a log that is written again reads the same; what
// can be played is played whole, in virtual time, without a step back. One program for each reader,
// by PITWALL_READER, so that each has its own time and its own corpus: for BLF the bytes are also
// the objects inside a file, as they are and packed. Without a reader the content decides, and
// what gzip packs reads as it does unpacked.
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "hil/replay/formats/asc.hpp"
#include "hil/replay/formats/blf.hpp"
#include "hil/replay/formats/candump.hpp"
#include "hil/replay/formats/log_reader.hpp"
#include "hil/replay/formats/pcap.hpp"
#include "hil/replay/formats/pcapng.hpp"
#include "hil/replay/formats/recognise.hpp"
#include "hil/replay/formats/trc.hpp"
#include "hil/replay/player.hpp"
#include "hil/replay/timeline.hpp"
#include "hil/replay/writers/blf_writer.hpp"
#include "hil/replay/writers/byte_text.hpp"
#include "hil/replay/writers/candump_writer.hpp"
#include "hil/replay/writers/gzip_writer.hpp"
#include "protocol/vocabulary/check.hpp"

#ifndef PITWALL_READER
#define PITWALL_READER read_can_log
#endif

namespace {

using namespace pitwall;
using namespace pitwall::replay;

struct VirtualIo {
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
  VirtualIo io;
  const PlayReport report = Player(*timeline, {.passes = 2, .late = late}, io).play({});
  CHECK(report.frames.sent == 2 * frames && io.sent == report.frames.sent && report.dropped() == 0);
}

void check(const Result<CanLog, Problem>& log) {
  if (!log) {
    CHECK(log.error().place.starts_with("f.log") && !log.error().what.empty());
    return;
  }
  CHECK(log->remarks.size() + log->remarks_left_off ==
        log->counters.bad_records + log->counters.cut_tails);
  check_round_trip(*log);
  play(*log, {}, LatePolicy::kCatchUp);
  play(*log, {.speed = 1e-3, .interface = "v", .longest_gap = seconds(5)}, LatePolicy::kDrop);
  play(*log, {.speed = 1e6, .interface = "v", .from = milliseconds(1)}, LatePolicy::kAbort);
}

void check_as_packed_by_gzip(std::string_view bytes, const Result<CanLog, Problem>& plain) {
  if (recognise(bytes) == FileFormat::kGzip) return;  // gzip inside gzip is refused
  const auto unpacked = read_can_log(*pack_gzip(bytes), "f.log");
  CHECK(plain.has_value() == unpacked.has_value());
  if (!plain) return;
  CHECK(plain->frames == unpacked->frames && plain->counters == unpacked->counters &&
        plain->channels == unpacked->channels && unpacked->format == plain->format + " (gzip)");
}

std::string container_of(std::string_view objects) {
  uLongf size = compressBound(static_cast<uLong>(objects.size()));
  std::string packed(size, '\0');
  CHECK(compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                  reinterpret_cast<const Bytef*>(objects.data()),
                  static_cast<uLong>(objects.size()), Z_BEST_SPEED) == Z_OK);
  constexpr std::uint32_t kHead = 32, kContainer = 10, kDeflated = 2;
  std::string out = "LOBJ";
  append_little(out, std::uint32_t{0x1'0010});  // header of 16 bytes, version 1
  append_little(out, static_cast<std::uint32_t>(kHead + size));
  append_little(out, kContainer);
  append_little(out, std::uint64_t{kDeflated});
  append_little(out, static_cast<std::uint64_t>(objects.size()));
  return out.append(packed, 0, size);
}

void check_blf_objects(std::string_view objects) {
  static const std::string kHeader = *to_blf({}, {});
  const std::size_t half = objects.size() / 2;  // an object may lie in both containers
  check(read_blf(kHeader + std::string(objects), "f.log"));
  check(
      read_blf(kHeader + container_of(objects.substr(0, half)) + container_of(objects.substr(half)),
               "f.log"));
}

#define PITWALL_TEXT(name) #name
#define PITWALL_NAME(name) PITWALL_TEXT(name)
constexpr std::string_view kName = PITWALL_NAME(PITWALL_READER);

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view file{reinterpret_cast<const char*>(bytes), size};
  const auto log = PITWALL_READER(file, "f.log");
  check(log);
  if (kName == "read_can_log") check_as_packed_by_gzip(file, log);
  if (kName == "read_blf") check_blf_objects(file);
  return 0;
}
