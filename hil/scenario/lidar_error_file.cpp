// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/lidar_error_file.hpp"

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::scenario {
namespace {

constexpr double kRangeMost_m = 500.0, kErrorMost_m = 10.0, kFalseMost = 10.0;
constexpr double kHalfTurn_deg = 180.0;

sensors::DetectorErrors read(yaml::StrictMap& map) {
  (void)map.text("detector");
  sensors::DetectorErrors errors{.rows = {},
                                 .false_per_sweep = map.number("false_per_sweep", 0.0, kFalseMost)};
  for (yaml::StrictMap& row : map.maps("ranges")) {
    const double from_m = row.number("from_m", 0.0, kRangeMost_m);
    const double to_m = row.number("to_m", 0.0, kRangeMost_m);
    if (to_m <= from_m) row.fail("to_m", "expected more than from_m");
    if (!errors.rows.empty() && errors.rows.back().to_m != from_m)
      row.fail("from_m", "expected the end of the range before it");
    errors.rows.push_back({.from_m = from_m,
                           .to_m = to_m,
                           .found_share = row.number("found", 0.0, 1.0),
                           .position_rms_m = row.number("position_rms_m", 0.0, kErrorMost_m),
                           .yaw_rms_rad = from_deg(row.number("yaw_rms_deg", 0.0, kHalfTurn_deg))});
  }
  if (errors.rows.empty()) map.fail("ranges", "expected one at least");
  return errors;
}

}  // namespace

Result<sensors::DetectorErrors, Problem> read_lidar_errors(std::string_view text,
                                                           const std::string& name) {
  const auto document = yaml::load_text(text, name);
  if (!document) return Unexpected{document.error()};
  return yaml::read(*document, [](yaml::StrictMap& map) { return read(map); });
}

}  // namespace pitwall::scenario
