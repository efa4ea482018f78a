// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/timeline.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/vehicle/autonomy/tracking/race.hpp"

namespace pitwall::tracking {
namespace {

using world::DetectionSource;

struct Line {
  std::unique_ptr<Timeline> timeline = std::make_unique<Timeline>();
  Tracks tracks;
  Params params;

  Insertion insert(std::int64_t ms, std::size_t detections = 1, std::uint8_t unit = 0) {
    const testing::Car own{.s_m = 100.0}, car{.s_m = 130.0, .n_m = 2.0};
    const double t_s = 1e-3 * static_cast<double>(ms);
    const Measurement m = testing::measured(
        DetectionSource::kLidar, testing::seen(DetectionSource::kLidar, own.at(t_s), car.at(t_s)));
    const std::vector<Measurement> list(detections, m);
    return timeline->insert({at_ms(ms), DetectionSource::kLidar, unit},
                            testing::own_motion(own.at(t_s)), list);
  }
  void settle() { timeline->settle(params, &testing::round_track(), tracks); }
};

TEST(Timeline, RepeatedFrameIsRefused) {
  Line line;
  EXPECT_EQ(line.insert(100), Insertion::kDone);
  EXPECT_EQ(line.insert(100), Insertion::kRepeated);
  EXPECT_EQ(line.insert(100, 1, 1), Insertion::kDone);
  line.settle();
  EXPECT_EQ(line.insert(100), Insertion::kRepeated);
  EXPECT_EQ(line.timeline->size(), 2U);
}

// Checkpoints are 0.1 s apart: what is given up is at most that older than asked for.
TEST(Timeline, ForgetsWhatIsBeforeTheWindow) {
  Line line;
  for (std::int64_t ms = 0; ms <= 3000; ms += 10) {
    line.timeline->forget_before(at_ms(ms - 1000));
    ASSERT_EQ(line.insert(ms), Insertion::kDone) << ms;
    line.settle();
    EXPECT_LE(line.timeline->size(), 112U);
  }
  EXPECT_EQ(line.insert(2001), Insertion::kDone);
  EXPECT_EQ(line.insert(2000), Insertion::kRepeated);
  EXPECT_EQ(line.insert(1899), Insertion::kTooOld);
  line.settle();
  EXPECT_EQ(line.tracks.list.size(), 1U);
  EXPECT_EQ(line.tracks.at, at_ms(3000));
}

TEST(Timeline, WithoutRoomAFrameIsRefused) {
  Line frames, detections;
  for (std::size_t i = 0; i < kFramesMax; ++i)
    ASSERT_EQ(frames.insert(static_cast<std::int64_t>(i), 0), Insertion::kDone);
  EXPECT_EQ(frames.insert(999, 0), Insertion::kNoRoom);
  std::size_t stored = 0;
  for (std::int64_t ms = 0; stored + kMeasurementsMax <= kStoredMax; ++ms) {
    ASSERT_EQ(detections.insert(ms, kMeasurementsMax), Insertion::kDone);
    stored += kMeasurementsMax;
  }
  EXPECT_EQ(detections.insert(999, kMeasurementsMax), Insertion::kNoRoom);
  EXPECT_EQ(detections.insert(999, kStoredMax - stored), Insertion::kDone);
  EXPECT_EQ(detections.insert(998, 1), Insertion::kNoRoom);
  EXPECT_EQ(detections.insert(998, 0), Insertion::kDone);
}

// Room comes back with time: through many times the size of the ring nothing is lost.
TEST(Timeline, RoomComesBack) {
  Line line;
  for (std::int64_t k = 0; k < 3000; ++k) {
    const std::int64_t ms = 20 * k + (k % 7 == 0 ? -330 : 0) + 400;
    line.timeline->forget_before(at_ms(20 * k + 400 - 1000));
    ASSERT_EQ(line.insert(ms + (k % 7 == 0 ? 3 : 0), static_cast<std::size_t>(k % 20)),
              Insertion::kDone)
        << k;
    line.settle();
  }
}

}  // namespace
}  // namespace pitwall::tracking
