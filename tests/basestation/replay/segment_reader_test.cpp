// SPDX-License-Identifier: Apache-2.0
#include "basestation/replay/segment_reader.hpp"

#include <gtest/gtest.h>

#include "protocol/recorder/segment_folder.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::replay {
namespace {

using testing::Console;
using testing::kRaceClock;
using testing::kRaceStart;

std::string one_segment() {
  const auto folder = transport::TemporaryFolder::create("pitwall_segment");
  testing::record_race(folder->path(), seconds(15));
  return *transport::read_file(recorder::segments_of(folder->path())->front());
}

TEST(SegmentReader, TimesAreThoseOfTheBaseThatRecorded) {
  const std::string file = one_segment();
  telemetry::Snapshot known;
  SegmentReader reader{as_bytes(file), kRaceClock, known};
  Console console;
  EXPECT_EQ(reader.due(), kRaceStart);
  while (reader.due()) reader.step(console);
  EXPECT_EQ(console.received.front(), kRaceStart);
  EXPECT_EQ(console.received.back(), kRaceStart + seconds(15));
  EXPECT_EQ(reader.unreadable(), 0U);
}

TEST(SegmentReader, APictureInTheMiddleSaysAllThatWasKnown) {
  const std::string file = one_segment();
  telemetry::Snapshot known;
  SegmentReader reader{as_bytes(file), kRaceClock, known};
  Console console;
  const Instant at = kRaceStart + seconds(10);
  ASSERT_TRUE(reader.restore(at, console));
  Console live;
  testing::Race{}.go_to(at - testing::kPacket, live);
  testing::expect_same(console.vehicle, live.vehicle, at);
}

TEST(SegmentReader, AnyBytesAreReadWithoutHarm) {
  const std::string whole = one_segment();
  for (std::size_t i = 0; i < 40; ++i) {
    std::string file = whole.substr(0, whole.size() - i * 1'001 % whole.size());
    for (std::size_t k = 0; k < 5; ++k) file[(i * 7'919 + k * 104'729) % file.size()] ^= 0x55;
    telemetry::Snapshot known;
    SegmentReader reader{as_bytes(file), kRaceClock, known};
    Console console;
    if (i % 2 == 0) reader.restore(kRaceStart + seconds(12), console);
    while (reader.due()) reader.step(console);
  }
}

}  // namespace
}  // namespace pitwall::replay
