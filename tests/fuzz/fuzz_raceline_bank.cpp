// SPDX-License-Identifier: Apache-2.0
// Any text is a bank of racelines of the ring below, or an error with a place. A bank is written
// and read again as itself, and each of its lines passes the check.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/raceline/bank_file.hpp"

namespace {

using namespace pitwall;

// Small, so that a seed is: 20 m of radius, 6 m to both walls.
struct Ring {
  world::TrackDescription description = [] {
    world::TrackDescription d;
    d.name = "ring", d.length_m = 40.0 * std::numbers::pi;
    d.datum_latitude_deg = 36.0, d.datum_longitude_deg = -115.0, d.datum_height_m = 600.0;
    d.start_x_m = 20.0, d.start_yaw_rad = 0.5 * std::numbers::pi;
    for (const double s_m : {0.0, 30.0, 60.0, 90.0}) d.knots.push_back({s_m, 0.05, 0.0, 6.0, 6.0});
    return d;
  }();
  world::TrackMap map = world::TrackMap::build(description).value();
  raceline::CarLimits car{.width_m = 2.0,
                          .wheelbase_m = 3.0,
                          .steer_max_rad = 0.3,
                          .steer_rate_max_rad_per_s = 0.6,
                          .corner_speed_mps = [](double, double) { return 10.0; }};

  auto read(std::string_view text) const {
    return raceline::read_bank(text, "f.json", description, map, car);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const Ring ring;
  const auto bank = ring.read({reinterpret_cast<const char*>(bytes), size});
  if (!bank) {
    CHECK(bank.error().place.starts_with("f.json"));
    CHECK(!bank.error().what.empty());
    return 0;
  }
  const std::string text = raceline::to_json(*bank);
  const auto again = ring.read(text);
  CHECK(again && raceline::to_json(*again) == text);
  for (const raceline::Raceline& line : again->lines)
    CHECK(raceline::check_raceline(line, raceline::Lanes{ring.map}, ring.car));
  return 0;
}
