// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/filter_params.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace pitwall::localization {
namespace {

std::optional<Problem> illegal_gates(std::span<const double> gates, const std::string& place) {
  for (std::size_t i = 0; i < gates.size(); ++i) {
    const std::string name = "gate_nis[" + std::to_string(i) + "]";
    const std::array one{world::LegalRange{name.c_str(), gates[i], kGateLeast, kGateMost}};
    if (auto problem = world::first_illegal(one, place)) return problem;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Problem> illegal(const FilterParams& p) {
  using world::first_illegal;
  const std::string planar = "filter.planar.", spatial = "filter.spatial.";
  if (auto problem = first_illegal(kFilterRanges, p, "filter.")) return problem;
  if (auto problem = first_illegal(kMotionNoiseRanges, p.planar.noise, planar)) return problem;
  if (auto problem = first_illegal(kPlanarRanges, p.planar, planar)) return problem;
  if (auto problem = illegal_gates(p.planar.gate_nis, planar)) return problem;
  if (auto problem = first_illegal(kSpatialRanges, p.spatial, spatial)) return problem;
  return illegal_gates(p.spatial.gate_nis, spatial);
}

}  // namespace pitwall::localization
