// SPDX-License-Identifier: Apache-2.0
#include "vehicle/receivers/sample_writer.hpp"

#include <gtest/gtest.h>

namespace pitwall::receivers {
namespace {

TEST(SampleWriter, GivesEverySampleItsUnitAndTimeAndCountsIt) {
  SampleWriter writer{1, milliseconds(2)};
  world::SensorInput out;
  const gnss::GpsTime stated = gnss::gps_time(2190, seconds(5));
  for (std::size_t k = 0; k < out.headings.capacity() + 3; ++k)
    writer.write(Stream::kHeading, stated + milliseconds(50) * static_cast<std::int64_t>(k),
                 Instant{} + seconds(7) + milliseconds(50) * static_cast<std::int64_t>(k),
                 world::GnssHeading{}, out.headings, out);
  ASSERT_TRUE(out.headings.full());
  EXPECT_EQ(out.headings[1].unit, 1);
  EXPECT_EQ(out.headings[1].at, Instant{} + milliseconds(7'048));
  EXPECT_EQ(out.overflows, 3U);
  EXPECT_EQ(writer.counters().samples[static_cast<std::size_t>(Stream::kHeading)],
            out.headings.capacity() + 3);
}

}  // namespace
}  // namespace pitwall::receivers
