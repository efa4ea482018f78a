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

TEST(Life, TrackIsLostWhereItIsNotSeenForLong) {
  Tracks tracks = with_one_on_trial();
  EXPECT_FALSE(is_lost(frame_at(400), tracks.list[0])) << "on trial";
  note_detection(frame_at(50), 0, tracks.list[0]);
  EXPECT_FALSE(is_lost(frame_at(350), tracks.list[0]));
  EXPECT_TRUE(is_lost(frame_at(351), tracks.list[0]));
}

TEST(Life, OneTrackEndsByItsPlace) {
  Tracks tracks;
  for (std::int64_t ms = 0; ms < 3; ++ms) {
    Track track;
    note_first(frame_at(ms), 0, track);
    add_track(track, tracks);
  }
  end_track(1, tracks);
  ASSERT_EQ(tracks.list.size(), 2U);
  EXPECT_EQ(tracks.list[0].first.frame.at, at_ms(0));
  EXPECT_EQ(tracks.list[1].first.frame.at, at_ms(2));
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

// Tracks that are only remembered make room for what is seen; the others stay in their order.
TEST(Life, TracksThatAreOnlyRememberedMakeRoom) {
  Tracks tracks;
  for (std::size_t i = 0; i < kTracksMax; ++i) {
    Track track;
    const Frame frame = frame_at(i == 7 ? 0 : i == 9 ? 10 : 4000);
    note_first(frame, 0, track);
    note_detection(frame, 1, track);
    add_track(track, tracks);
  }
  make_room(frame_at(5000), seconds(5), tracks);
  EXPECT_EQ(tracks.list.size(), kTracksMax) << "all are shown still";
  make_room(frame_at(5005), seconds(5), tracks);
  ASSERT_EQ(tracks.list.size(), kTracksMax - 1) << "two detections, but only one is older";
  EXPECT_EQ(tracks.list[8].newest.frame.at, at_ms(10));
  make_room(frame_at(5011), seconds(5), tracks);
  ASSERT_EQ(tracks.list.size(), kTracksMax - 2);
  make_room(frame_at(9001), seconds(5), tracks);
  EXPECT_EQ(tracks.list.size(), kTracksMax - 2) << "there is room for two";
}

}  // namespace
}  // namespace pitwall::tracking
