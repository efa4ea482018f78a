// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/vectornav_fields.hpp"

#include <gtest/gtest.h>

#include "protocol/gnss/vectornav_codec.hpp"

namespace pitwall::gnss {
namespace {

struct Order {
  unsigned last = 0;
  std::uint32_t written = 0;
  bool rising = true;

  template <class... Field>
  void operator()(unsigned bit, Kind, const Field&...) {
    see(bit);
    written |= 1U << bit;
  }
  void skip(unsigned bit, std::size_t) { see(bit); }
  void see(unsigned bit) {
    rising = rising && bit >= last && bit < 32 && bit != 15;  // 15 is the extension
    last = bit;
  }
};

TEST(VectorNavFields, BitsRiseAsTheyAreSent) {
  const VectorNavMessage message;
  for (std::size_t i = 0; i < kVectorNavGroups; ++i) {
    const auto group = static_cast<VectorNavGroup>(i);
    Order order;
    visit_fields(group, message, order);
    EXPECT_TRUE(order.rising) << i;
    EXPECT_EQ(order.written, writable_fields(group)) << i;
  }
}

TEST(VectorNavFields, TheNamedBitsAreWritable) {
  for (const VectorNavField field : {vectornav::kTimeGps,
                                     vectornav::kTimeUtc,
                                     vectornav::kTimeStatus,
                                     vectornav::kImuStatus,
                                     vectornav::kAccel,
                                     vectornav::kAngularRate,
                                     vectornav::kYawPitchRoll,
                                     vectornav::kYawPitchRollUncertainty,
                                     vectornav::kInsStatus,
                                     vectornav::kInsPosition,
                                     vectornav::kInsVelocity,
                                     vectornav::kInsPositionUncertainty,
                                     vectornav::kInsVelocityUncertainty,
                                     vectornav::kGnssFix,
                                     vectornav::kGnssPosition,
                                     vectornav::kGnssVelocity,
                                     vectornav::kGnssPositionUncertainty,
                                     vectornav::kGnssTimeInfo,
                                     vectornav::kGnssStatus,
                                     vectornav::kCommonInsStatus}) {
    EXPECT_NE(writable_fields(field.group) >> field.bit & 1U, 0U);
  }
}

}  // namespace
}  // namespace pitwall::gnss
