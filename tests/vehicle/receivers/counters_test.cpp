// SPDX-License-Identifier: Apache-2.0
#include "vehicle/receivers/counters.hpp"

#include <gtest/gtest.h>

namespace pitwall::receivers {
namespace {

TEST(Counters, NothingOfTheStreamIsLost) {
  gnss::StreamCounters stream;
  stream.bytes = 1, stream.frames = 2, stream.garbage_bytes = 3, stream.bad_crc = 4;
  stream.resyncs = 5;
  stream.oversize = 10, stream.bad_header = 100, stream.unexpected = 1'000;
  Counters own;
  own.unused = 7;
  const Counters all = with_stream(own, stream);
  EXPECT_EQ(all.bytes, 1U);
  EXPECT_EQ(all.frames, 2U);
  EXPECT_EQ(all.garbage_bytes, 3U);
  EXPECT_EQ(all.bad_checksum, 4U);
  EXPECT_EQ(all.bad_frame, 1'110U);
  EXPECT_EQ(all.resyncs, 5U);
  EXPECT_EQ(all.unused, 7U);
}

TEST(Counters, ThePitWallIsToldEveryRefusal) {
  Counters c;
  c.bytes = 1, c.frames = 2, c.bad_checksum = 3, c.bad_frame = 4, c.resyncs = 5;
  c.refused.count(gnss::DecodeError::kNotFinite);
  c.time_unknown = 10, c.out_of_range = 100, c.imu_error = 1'000;
  const world::ReceiverTraffic t = traffic_of(c);
  EXPECT_EQ(t.bytes, 1U);
  EXPECT_EQ(t.logs, 2U);
  EXPECT_EQ(t.bad_checksum, 3U);
  EXPECT_EQ(t.bad_frame, 4U);
  EXPECT_EQ(t.resyncs, 5U);
  EXPECT_EQ(t.refused, 1'111U);
  EXPECT_EQ(t.lost, 0U);
}

}  // namespace
}  // namespace pitwall::receivers
