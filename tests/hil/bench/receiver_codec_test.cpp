// Whatever happens to a receiver's bytes, the car is told what the receiver said, or nothing.
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/receiver_codec.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::bench {
namespace {

// Positions that tell by their latitude which they are.
world::GnssPosition position(std::uint8_t unit, int k) {
  return {.unit = unit,
          .at = Instant{} + milliseconds(50 * k),
          .solution_status = world::kSolutionComputed,
          .position_type = world::kPositionNarrowInt,
          .latitude_deg = 36.0 + 1e-6 * k,
          .longitude_deg = -115.0 - 1e-6 * k,
          .height_m = 594.0,
          .latitude_sigma_m = 0.01,
          .longitude_sigma_m = 0.01,
          .height_sigma_m = 0.02,
          .satellites = 18,
          .differential_age_s = 1.0,
          .solution_age_s = 0.0};
}

world::GnssVelocity velocity(std::uint8_t unit, int k) {
  return {.unit = unit,
          .at = Instant{} + milliseconds(50 * k),
          .solution_status = world::kSolutionComputed,
          .velocity_type = world::kPositionNarrowInt,
          .horizontal_mps = 60.0,
          .track_over_ground_rad = 1.0,
          .vertical_mps = 0.0,
          .sigma_mps = 0.03};
}

struct Count {
  int received = 0, wrong = 0;
};

Count run(world::ReceiverKind kind, double share, int epochs) {
  const world::Receivers units{{{.kind = kind}, {.kind = kind}}};
  ReceiverEncoder encoder{
      units,
      {{.kind = faults::BenchFaultKind::kGnssBytesDamaged, .unit = 0, .value = share, .seed = 4}}};
  ReceiverDecoder decoder{units};
  Count count;
  for (int k = 1; k <= epochs; ++k) {
    world::SensorInput samples;
    EXPECT_TRUE(samples.positions.push(position(0, k)));
    EXPECT_TRUE(samples.velocities.push(velocity(0, k)));
    const Instant now = Instant{} + milliseconds(50 * k + 30);
    encoder.encode(samples, now, [&](std::uint8_t unit, std::span<const std::uint8_t> bytes) {
      decoder.receive(unit, bytes, now);
    });
    for (const world::GnssPosition& p : decoder.samples().positions) {
      ++count.received;
      const int stated = static_cast<int>(std::lround((p.latitude_deg - 36.0) * 1e6));
      const world::GnssPosition sent = position(0, stated);
      const bool right = stated >= 1 && stated <= k && p.latitude_deg == sent.latitude_deg &&
                         p.longitude_deg == sent.longitude_deg && p.height_m == sent.height_m &&
                         p.position_type == sent.position_type && p.satellites == sent.satellites;
      if (!right) ++count.wrong;
    }
    for (const world::GnssVelocity& v : decoder.samples().velocities)
      if (std::abs(v.horizontal_mps - 60.0) > 1e-5) ++count.wrong;
    decoder.clear();
  }
  return count;
}

TEST(DamagedReceivers, ANovatelIsNeverMisunderstood) {
  constexpr int kEpochs = 40'000;
  const Count count = run(world::ReceiverKind::kNovatelOem7, 0.5, kEpochs);
  EXPECT_EQ(count.wrong, 0);
  EXPECT_GT(count.received, kEpochs / 3) << "the sound ones are heard";
}

// Its checksum has 16 bits: of a message that is spoiled, one in 65,536 passes. The innovation
// gates of localization stand behind it.
TEST(DamagedReceivers, AVectorNavIsHardlyEverMisunderstood) {
  constexpr int kEpochs = 40'000;
  const Count count = run(world::ReceiverKind::kVectorNav, 0.5, kEpochs);
  EXPECT_LE(count.wrong, 2);
  EXPECT_GT(count.received, kEpochs / 3);
}

TEST(DamagedReceivers, ASoundStreamLosesNothing) {
  for (const auto kind : {world::ReceiverKind::kNovatelOem7, world::ReceiverKind::kVectorNav}) {
    const Count count = run(kind, 0.0, 2'000);
    EXPECT_EQ(count.received, 2'000);
    EXPECT_EQ(count.wrong, 0);
  }
}

}  // namespace
}  // namespace pitwall::bench
