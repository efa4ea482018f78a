// SPDX-License-Identifier: Apache-2.0
// What a sensor that detects other cars may send, as the first byte chooses it: nothing breaks,
// every message has exactly one count, and what is taken has numbers that tracking can read.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/io/ingress/detection_inbox.hpp"

namespace {

using namespace pitwall;
using io::SensorType;

constexpr UtcTime kUtc{1'800'000'000 * kNanosecondsPerSecond};
constexpr Instant kNow{seconds(100).ns};

io::DetectionRow row() {
  io::DetectionRow made;
  made.camera = perception::CameraModel::pinhole(900.0, 640.0), made.height_m = 1.2;
  made.amplitude_0_db = 0.0, made.amplitude_1_db = 30.0;
  return made;
}

bool is_number_or_unset(double v) { return !std::isinf(v); }

void check(const world::DetectionFrame& frame) {
  CHECK(frame.at <= kNow + io::DetectionInbox::kAheadMost);
  CHECK(frame.at >= kNow - io::DetectionInbox::kOldest);
  for (const world::Detection& d : frame.detections) {
    CHECK(d.confidence >= 0.0 && d.confidence <= 1.0);
    for (const double v : {d.x_m, d.y_m, d.yaw_rad, d.length_m, d.width_m, d.bearing_rad,
                           d.inverse_depth_per_m, d.range_m, d.range_rate_mps})
      CHECK(is_number_or_unset(v));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr SensorType kTypes[] = {SensorType::kDetection3DArray, SensorType::kDetection2DArray,
                                   SensorType::kRadarScan};
  io::DetectionInbox inbox{kTypes[data[0] % 3], row()};
  const std::span<const std::uint8_t> cdr{data + 1, size - 1};
  const bool is_taken = inbox.receive(cdr, kUtc, kNow).has_value();
  const io::DetectionCounts n = inbox.counts();
  CHECK(n.taken == (is_taken ? 1U : 0U));
  CHECK(n.taken + n.refused + n.in_future + n.too_old + n.foreign_frames + n.too_many + n.no_room ==
        1U);
  CHECK((inbox.front() != nullptr) == is_taken);
  if (is_taken) check(*inbox.front());
  return 0;
}
