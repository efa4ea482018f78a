// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/life.hpp"

#include <gtest/gtest.h>

#include "tests/support/instants.hpp"

namespace pitwall::tracking {
namespace {

using world::DetectionSource;

const std::array<Measurement, 2> kTwo{Measurement{.confidence = 0.8}, {.confidence = 0.7}};

Frame frame_at(std::int64_t ms, DetectionSource source = DetectionSource::kLidar,
               std::uint8_t unit = 0) {
  return {.key = {at_ms(ms), source, unit}, .own = {}, .measurements = kTwo};
}

Tracks with_one_on_trial() {
  Tracks tracks;
  Track track;
  note_first(frame_at(0), 1, track);
  add_track(track, tracks);
  return tracks;
}

TEST(Life, SecondDetectionConfirms) {
  Tracks tracks = with_one_on_trial();
  Track& track = tracks.list[0];
  EXPECT_FALSE(track.confirmed);
  note_detection(frame_at(50), 0, track);
  EXPECT_TRUE(track.confirmed);
  EXPECT_EQ(track.born_at, at_ms(50));
  EXPECT_EQ(track.confidence, 0.8);
  EXPECT_EQ(track.first, (DetectionKey{frame_at(0).key, 1}));
  note_detection(frame_at(100), 0, track);
  EXPECT_EQ(track.born_at, at_ms(50));
  EXPECT_EQ(track.previous.frame.at, at_ms(50));
}

TEST(Life, TrialEndsWithTheNextFrameOfItsSensor) {
  Tracks tracks = with_one_on_trial();
  end_tracks(frame_at(0), seconds(5), tracks);
  end_tracks(frame_at(20, DetectionSource::kRadar), seconds(5), tracks);
  end_tracks(frame_at(30, DetectionSource::kLidar, 1), seconds(5), tracks);
  EXPECT_EQ(tracks.list.size(), 1U);
  end_tracks(frame_at(50), seconds(5), tracks);
  EXPECT_EQ(tracks.list.size(), 0U);
}

TEST(Life, TrialEndsWhereItsSensorIsSilent) {
  Tracks tracks = with_one_on_trial();
  end_tracks(frame_at(500, DetectionSource::kRadar), seconds(5), tracks);
  EXPECT_EQ(tracks.list.size(), 1U);
  end_tracks(frame_at(501, DetectionSource::kRadar), seconds(5), tracks);
  EXPECT_EQ(tracks.list.size(), 0U);
}

TEST(Life, ConfirmedTrackEndsAfterItsTime) {
  Tracks tracks = with_one_on_trial();
  note_detection(frame_at(50), 0, tracks.list[0]);
  end_tracks(frame_at(5050), seconds(5), tracks);
  EXPECT_EQ(tracks.list.size(), 1U);
  end_tracks(frame_at(5051), seconds(5), tracks);
  EXPECT_EQ(tracks.list.size(), 0U);
}

// A detection after that time is not of the track, so it ends before them.
TEST(Life, UnseenTrackEndsBeforeTheDetections) {
  Tracks tracks = with_one_on_trial();
  end_unseen(frame_at(500), seconds(5), tracks);
  EXPECT_EQ(tracks.list.size(), 1U) << "its sensor may still see it";
  note_detection(frame_at(500), 0, tracks.list[0]);
  end_unseen(frame_at(5500), seconds(5), tracks);
  EXPECT_EQ(tracks.list.size(), 1U);
  end_unseen(frame_at(5501), seconds(5), tracks);
  EXPECT_EQ(tracks.list.size(), 0U);
}

TEST(Life, OthersKeepTheirOrder) {
  Tracks tracks;
  for (std::int64_t ms = 0; ms < 6; ++ms) {
    Track track;
    note_first(frame_at(ms), 0, track);
    note_detection(frame_at(ms % 2 == 0 ? ms : 3000 + ms), 0, track);
    add_track(track, tracks);
  }
  end_tracks(frame_at(7000), seconds(5), tracks);
  ASSERT_EQ(tracks.list.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(tracks.list[i].first.frame.at, at_ms(static_cast<std::int64_t>(2 * i + 1)));
}

TEST(Life, TrackWithoutRoomIsCounted) {
  Tracks tracks;
  for (std::size_t i = 0; i < kTracksMax + 3; ++i) add_track(Track{}, tracks);
  EXPECT_EQ(tracks.list.size(), kTracksMax);
  EXPECT_EQ(tracks.crowded, 3U);
}

}  // namespace
}  // namespace pitwall::tracking
