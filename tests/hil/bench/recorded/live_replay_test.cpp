// A run that is really played is in tests/system/recorded.
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/live_replay.hpp"

#include <gtest/gtest.h>

#include "hil/replay/recordings/recording_reader.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "tests/hil/bench/recorded/recorded_drive.hpp"

namespace pitwall::bench {
namespace {

traffic::Recording recorded_traffic() {
  const std::string file = recorder::segments_of(recorded_folder())->front();
  return *traffic::read_recording(*transport::read_file(file), file);
}

TEST(LiveReplay, ARecordingWithNothingToPlayIsRefusedBeforeAnythingStarts) {
  const LivePlan plan{.interface = "unix:/nowhere", .vehicle = {"/nowhere"}};
  traffic::Recording recording = recorded_traffic();
  std::erase_if(recording.records, [&](const traffic::Record& record) {
    return recording.sources[record.source].name != "/car/tick";
  });
  const auto played = play_to_car(std::move(recording), {}, plan);
  ASSERT_FALSE(played);
  EXPECT_EQ(to_string(played.error()),
            "recording: error: holds no input of the car: neither frames nor bytes of receivers");
  EXPECT_FALSE(play_to_car({}, {}, plan));
}

TEST(LiveReplay, ABusThatIsNotThereIsAProblemThatNamesIt) {
  const LivePlan plan{.interface = "unix:/nowhere/bus", .vehicle = {"/nowhere"}};
  CommandTrace trace;
  trace.length = seconds(1);
  const auto played = play_to_car(recorded_traffic(), trace, plan);
  ASSERT_FALSE(played);
  EXPECT_NE(to_string(played.error()).find("/nowhere/bus"), std::string::npos)
      << to_string(played.error());
}

}  // namespace
}  // namespace pitwall::bench
