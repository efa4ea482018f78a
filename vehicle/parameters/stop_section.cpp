// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/stop_section.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "vehicle/parameters/range_reader.hpp"

namespace pitwall::parameters {
namespace {

world::TyreGrip read_tyres(yaml::StrictMap map) {
  world::TyreGrip tyres;
  const auto rows = world::kTyreRows;
  const auto temperature_c = map.numbers("temperature_c", rows, rows, -50.0, 150.0);
  const auto share = map.numbers("share", rows, rows, 0.05, 1.0);
  std::copy(temperature_c.begin(), temperature_c.end(), tyres.temperature_c.begin());
  std::copy(share.begin(), share.end(), tyres.share.begin());
  if (!world::is_legal(tyres)) map.fail("share", "temperatures must rise and shares not fall");
  return tyres;
}

template <std::size_t N>
void read_row(yaml::StrictMap& map, const char* key, world::Range range,
              std::array<double, N>& row) {
  const auto values = map.numbers(key, N, N, range.least, range.most);
  std::copy(values.begin(), values.end(), row.begin());
}

envelope::Engine read_engine(yaml::StrictMap map) {
  envelope::Engine engine;
  read_row(map, "rpm", envelope::kEngineSpeed_rpm, engine.rpm);
  read_row(map, "torque_nm", envelope::kEngineTorque_nm, engine.torque_nm);
  std::vector<yaml::StrictMap> part = map.maps("part_throttle");
  if (part.size() != envelope::kPartThrottles)
    map.fail("part_throttle",
             "expected one row per throttle: " + std::to_string(envelope::kPartThrottles));
  for (std::size_t i = 0; i < part.size(); ++i) {
    const auto [least, most] = envelope::kThrottle;
    engine.part_throttle[i].throttle = part[i].number("throttle", least, most);
    read_row(part[i], "share", envelope::kTorqueShare, engine.part_throttle[i].share);
  }
  read_row(map, "ratio", envelope::kGearRatio, engine.ratio);
  read_ranges(map, envelope::kEngineRanges, engine);
  if (!envelope::is_legal(engine))
    map.fail("rpm", "engine speeds, throttles and their shares must rise and ratios fall");
  return engine;
}

}  // namespace

envelope::FrictionParams read_friction(yaml::StrictMap map) {
  envelope::FrictionParams f;
  read_ranges(map, envelope::kFrictionRanges, f);
  f.tyres = read_tyres(map.map("tyres"));
  if (auto engine = map.optional_map("engine")) f.engine = read_engine(*engine);
  return f;
}

void read_stop_plan(yaml::StrictMap map, planning::Params& p) {
  read_ranges(map, planning::kStopPathRanges, p.stop_path);
  p.emergency_decel_max_mps2 = map.number("emergency_decel_max_mps2", p.stop_decel_max_mps2, 15.0);
  p.emergency_jerk_max_mps3 = map.number("emergency_jerk_max_mps3", p.stop_jerk_max_mps3, 30.0);
  p.emergency_grip_share = map.number("emergency_grip_share", p.stop_grip_share, 0.95);
}

}  // namespace pitwall::parameters
