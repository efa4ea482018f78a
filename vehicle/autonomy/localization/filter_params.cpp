// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter_params.hpp"

#include <cstddef>
#include <span>
#include <string>

#include "vehicle/world/legal_range.hpp"

namespace pitwall::localization {
namespace {

using world::LegalRange;

std::optional<Problem> at_place(const std::string& place, std::span<const LegalRange> ranges) {
  auto problem = world::first_illegal(ranges);
  if (problem) problem->place = place + problem->place;
  return problem;
}

template <class Params, std::size_t N>
std::optional<Problem> illegal_in(const std::array<NamedRange<Params>, N>& ranges,
                                  const Params& params, const std::string& place) {
  for (const NamedRange<Params>& r : ranges) {
    const std::array one{LegalRange{r.name, params.*r.value, r.least, r.most}};
    if (auto problem = at_place(place, one)) return problem;
  }
  return std::nullopt;
}

std::optional<Problem> illegal_gates(std::span<const double> gates, const std::string& place) {
  for (std::size_t i = 0; i < gates.size(); ++i) {
    const std::string name = "gate_nis[" + std::to_string(i) + "]";
    const std::array one{LegalRange{name.c_str(), gates[i], kGateLeast, kGateMost}};
    if (auto problem = at_place(place, one)) return problem;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Problem> illegal(const FilterParams& p) {
  const std::array shared{LegalRange{"window_s", p.window_s, kWindowLeast_s, kWindowMost_s},
                          LegalRange{"reentry_mps", p.reentry_mps, 0.5, 5.0}};
  if (auto problem = at_place("filter.", shared)) return problem;
  if (auto problem = illegal_in(kMotionNoiseRanges, p.planar.noise, "filter.planar."))
    return problem;
  if (auto problem = illegal_in(kPlanarRanges, p.planar, "filter.planar.")) return problem;
  if (auto problem = illegal_gates(p.planar.gate_nis, "filter.planar.")) return problem;
  if (auto problem = illegal_in(kSpatialRanges, p.spatial, "filter.spatial.")) return problem;
  return illegal_gates(p.spatial.gate_nis, "filter.spatial.");
}

}  // namespace pitwall::localization
