// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/names.hpp"

#include <gtest/gtest.h>

#include "tests/support/instants.hpp"

namespace pitwall::tracking {
namespace {

DetectionKey key(std::int64_t ms, std::uint8_t index) {
  return {{at_ms(ms), world::DetectionSource::kLidar, 0}, index};
}

Track track_of(DetectionKey first, DetectionKey previous, DetectionKey newest) {
  Track t;
  t.confirmed = true;
  t.first = first, t.previous = previous, t.newest = newest;
  return t;
}

Tracks tracks_of(std::initializer_list<Track> list) {
  Tracks tracks;
  for (const Track& t : list) (void)tracks.list.push(t);
  return tracks;
}

TEST(Names, EveryConfirmedTrackHasItsOwn) {
  Names names;
  Track trial = track_of(key(0, 2), key(0, 2), key(0, 2));
  trial.confirmed = false;
  const Track a = track_of(key(0, 0), key(0, 0), key(50, 0)),
              b = track_of(key(0, 1), key(0, 1), key(50, 1));
  names.name(tracks_of({a, trial, b}));
  EXPECT_EQ(names.id_of(a), 1U);
  EXPECT_EQ(names.id_of(b), 2U);
  EXPECT_EQ(names.id_of(trial), 0U);
  names.name(tracks_of({b, a}));
  EXPECT_EQ(names.id_of(a), 1U);
  EXPECT_EQ(names.id_of(b), 2U);
}

TEST(Names, NumberOfATrackThatEndedIsNotUsedAgain) {
  Names names;
  names.name(tracks_of({track_of(key(0, 0), key(0, 0), key(50, 0))}));
  names.name(Tracks{});
  const Track later = track_of(key(900, 0), key(900, 0), key(950, 0));
  names.name(tracks_of({later}));
  EXPECT_EQ(names.id_of(later), 2U);
}

// A late frame found an older first detection; the newest one is the same, or the one before it.
TEST(Names, StayWithTheDetections) {
  Names names;
  names.name(tracks_of({track_of(key(50, 0), key(100, 0), key(150, 0)),
                        track_of(key(50, 1), key(100, 1), key(150, 1))}));
  const Track a = track_of(key(0, 1), key(100, 0), key(150, 0)),
              b = track_of(key(0, 0), key(150, 1), key(200, 0));
  names.name(tracks_of({b, a}));
  EXPECT_EQ(names.id_of(a), 1U);
  EXPECT_EQ(names.id_of(b), 2U);
  EXPECT_EQ(names.given, 2U);
}

// A detection that went from one track to another takes no number of a track that is still there.
TEST(Names, NumberInUseIsNotTaken) {
  Names names;
  const Track a = track_of(key(50, 0), key(100, 0), key(150, 0));
  names.name(tracks_of({a}));
  const Track moved = track_of(key(50, 0), key(100, 0), key(160, 0)),
              other = track_of(key(60, 3), key(100, 0), key(150, 0));
  names.name(tracks_of({moved, other}));
  EXPECT_EQ(names.id_of(moved), 1U);
  EXPECT_EQ(names.id_of(other), 2U);
}

}  // namespace
}  // namespace pitwall::tracking
