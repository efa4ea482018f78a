// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/lcm_recording.hpp"

#include <gtest/gtest.h>
#include <lcm/eventlog.h>

#include "hil/replay/recordings/mcap_recording.hpp"
#include "protocol/recorder/recorder.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/recording/lcm_log.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/replay/recordings/recording_samples.hpp"

namespace pitwall::traffic {
namespace {

// What our recorder writes of one run: a segment and the LCM log beside it.
struct Twins {
  std::string mcap, lcm;
};

Twins recorded() {
  const auto folder = transport::TemporaryFolder::create("pitwall_recordings");
  const Instant now = transport::monotonic_now();
  {
    auto recorder = recorder::Recorder::start(folder->path(), {});
    EXPECT_TRUE(recorder);
    for (std::uint32_t i = 0; i < 200; ++i) {
      const Instant at = now + milliseconds(10) * i;
      (*recorder)->can(false, at, testing::some_frame(i));
      (*recorder)->can(true, at, testing::some_frame(i + 1));
      (*recorder)->receiver(0, at, as_bytes(testing::novatel_position(2'297, 1'000 * i)));
      (*recorder)->datagram(true, at, {.path = 1, .bytes = as_bytes("on the air")});
    }
    (*recorder)->text(recorder::Topic::kMark, now, R"({"type":"mark"})");
  }
  const auto paths = recorder::segments_of(folder->path());
  EXPECT_TRUE(paths && paths->size() == 1);
  Twins twins{testing::bytes_of(paths->front()), {}};
  for (const auto& entry : std::filesystem::recursive_directory_iterator{folder->path()})
    if (entry.path().extension() == ".lcm") twins.lcm = testing::bytes_of(entry.path());
  return twins;
}

// CAN and receivers, with stamps in whole microseconds as LCM has them.
std::vector<std::string> traffic_of(const Recording& recording) {
  std::vector<std::string> lines;
  for (Record record : recording.records) {
    const SourceKind kind = recording.sources[record.source].kind;
    if (kind != SourceKind::kCan && kind != SourceKind::kReceiver) continue;
    record.at.ns -= record.at.ns % 1'000;
    lines.push_back(testing::line_of(recording, record));
  }
  std::ranges::sort(lines);
  return lines;
}

TEST(LcmRecording, OfOurRecorderItHasTheTrafficOfTheSegmentBeside) {
  const Twins twins = recorded();
  const auto lcm = read_lcm(twins.lcm, "run.lcm");
  const auto mcap = read_mcap(twins.mcap, "run.mcap");
  ASSERT_TRUE(lcm && mcap);
  testing::expect_sound(*lcm);
  EXPECT_EQ(traffic_of(*lcm), traffic_of(*mcap));
  EXPECT_EQ(traffic_of(*lcm).size(), 600U);
  const auto gnss = std::ranges::find(lcm->sources, "/gnss/0", &Source::name);
  ASSERT_NE(gnss, lcm->sources.end());
  EXPECT_EQ(gnss->type, "novatel");
  EXPECT_EQ(testing::all_remarks(*lcm), "");
}

TEST(LcmRecording, LcmsOwnReaderReadsTheSameEvents) {
  const Twins twins = recorded();
  const std::string path = testing::scratch("twin.lcm");
  testing::write_bytes(path, twins.lcm);
  lcm_eventlog_t* log = lcm_eventlog_create(path.c_str(), "r");
  ASSERT_NE(log, nullptr);
  std::map<std::string, std::uint64_t> theirs, ours;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log)) {
    ++theirs[std::string{event->channel} + " " + std::to_string(event->timestamp)];
    lcm_eventlog_free_event(event);
  }
  lcm_eventlog_destroy(log);
  const auto recording = read_lcm(twins.lcm, path);
  for (const Record& record : recording->records)
    ++ours[recording->sources[record.source].name + " " + std::to_string(record.at.ns / 1'000)];
  EXPECT_EQ(ours, theirs);
  EXPECT_GE(recording->records.size(), 801U);
}

TEST(LcmRecording, MessagesOfOthersAreKeptAsTheyAre) {
  testing::ByteSink file;
  recording::LcmLogWriter writer{file.sink()};
  const std::string message = "12345678 of another maker";
  ASSERT_TRUE(writer.write(UtcTime{1'000}, "POSE", as_bytes(message)));
  ASSERT_TRUE(writer.write(UtcTime{2'000}, "POSE", as_bytes("short")));
  const auto recording = read_lcm(file.bytes, "a.lcm");
  ASSERT_TRUE(recording);
  ASSERT_EQ(recording->sources.size(), 2U);  // two types on one channel
  EXPECT_EQ(recording->sources[0].type, "lcm 0x3132333435363738");
  EXPECT_EQ(recording->records[0].bytes().size(), message.size());
}

TEST(LcmRecording, BytesOfNoEventAreToldWithTheirPlace) {
  const Twins twins = recorded();
  const auto all = testing::sorted_lines(*read_lcm(twins.lcm, "run.lcm"));
  std::string bad = twins.lcm;
  const std::size_t second = bad.find("\xED\xA1\xDA\x01", 4);
  bad.insert(second, "not an event");
  const auto recording = read_lcm(bad, "run.lcm");
  const auto lines = testing::sorted_lines(*recording);
  EXPECT_TRUE(std::ranges::includes(all, lines));
  EXPECT_EQ(lines.size() + 1, all.size()) << "the event in front is lost with it";
  EXPECT_EQ(recording->counters.lost_bytes, second + 12);
  EXPECT_EQ(testing::all_remarks(*recording),
            "run.lcm: byte 0: bytes of no whole event: left out, " + std::to_string(second + 12) +
                " bytes\n");
}

TEST(LcmRecording, NoDamageThatMovesBytesIsSilent) {
  const Twins twins = recorded();
  const auto all = testing::sorted_lines(*read_lcm(twins.lcm, "run.lcm"));
  testing::Dice dice{3};
  for (int i = 0; i < 300; ++i) {
    const std::string bad = testing::damaged(twins.lcm, dice);
    const auto recording = read_lcm(bad, "run.lcm");
    if (!recording) continue;
    testing::expect_sound(*recording);
    const bool same = testing::sorted_lines(*recording) == all;
    if (!same && bad.size() != twins.lcm.size() && bad != twins.lcm.substr(0, bad.size())) {
      EXPECT_NE(testing::all_remarks(*recording), "") << i;
    }
  }
}

TEST(LcmRecording, RefusesAFileWithoutAnEvent) {
  const auto recording = read_lcm(std::string{"nothing"}, "a.lcm");
  ASSERT_FALSE(recording);
  EXPECT_EQ(to_string(recording.error()), "a.lcm: byte 0: error: holds no event of LCM");
}

}  // namespace
}  // namespace pitwall::traffic
