// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/lcm_encoder.hpp"

#include <gtest/gtest.h>

#include "protocol/telemetry/export/lcm_schema.hpp"
#include "tests/protocol/recorder/recorded_time.hpp"

namespace pitwall::recorder {
namespace {

TEST(LcmEncoder, EveryChannelButPictureAndTickHasAMessageUnderItsOwnName) {
  const LcmEncoder encoder{kClock};
  const auto all = channels();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto channel = static_cast<std::uint16_t>(i);
    EXPECT_EQ(encoder.has(channel), channel != kSnapshotChannel && channel != kTickChannel)
        << all[i].topic;
    EXPECT_EQ(encoder.topic(channel), all[i].topic);
  }
  EXPECT_FALSE(encoder.has(static_cast<std::uint16_t>(all.size())));
}

TEST(LcmEncoder, ATextIsItsFingerprintItsTimeItsLengthAndItsZero) {
  const LcmEncoder encoder{kClock};
  const std::vector<std::uint8_t> text{'h', 'i'};
  std::vector<std::uint8_t> out{1, 2, 3};
  encoder.encode({.channel = channel_of(Topic::kMark),
                  .logged = Instant{2},
                  .published = Instant{1'000},
                  .data = text},
                 out);
  std::vector<std::uint8_t> wanted;
  const auto put = [&wanted](std::uint64_t number, int bytes) {
    for (int i = bytes; i-- > 0;) wanted.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
  };
  put(telemetry::lcm_fingerprint(telemetry::lcm_text_type()), 8);
  put(1'700'000'000'000'001, 8);
  put(3, 4);
  wanted.insert(wanted.end(), {'h', 'i', 0});
  EXPECT_EQ(out, wanted);
  EXPECT_EQ(encoder.utc(Instant{5}).ns, seconds(1'700'000'000).ns + 5);
}

}  // namespace
}  // namespace pitwall::recorder
