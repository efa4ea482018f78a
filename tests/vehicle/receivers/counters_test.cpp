// SPDX-License-Identifier: Apache-2.0
#include "vehicle/receivers/counters.hpp"

#include <gtest/gtest.h>

namespace pitwall::receivers {
namespace {

TEST(Counters, NothingOfTheStreamIsLost) {
  gnss::StreamCounters stream;
  stream.bytes = 1, stream.frames = 2, stream.garbage_bytes = 3, stream.bad_crc = 4;
  stream.oversize = 10, stream.bad_header = 100, stream.unexpected = 1'000;
  Counters own;
  own.unused = 7;
  const Counters all = with_stream(own, stream);
  EXPECT_EQ(all.bytes, 1U);
  EXPECT_EQ(all.frames, 2U);
  EXPECT_EQ(all.garbage_bytes, 3U);
  EXPECT_EQ(all.bad_checksum, 4U);
  EXPECT_EQ(all.bad_frame, 1'110U);
  EXPECT_EQ(all.unused, 7U);
}

}  // namespace
}  // namespace pitwall::receivers
