// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/setup.hpp"

#include <utility>

namespace pitwall::pipeline {

Result<Setup, Problem> prepare(const CarParams& params, const world::TrackDescription& track) {
  auto map = world::TrackMap::build(track);
  if (!map) return Unexpected{map.error()};
  auto datum = localization::Datum::at(map->datum_latitude_deg(), map->datum_longitude_deg(),
                                       map->datum_height_m());
  if (!datum) return Unexpected{datum.error()};
  auto localization = localization::checked(params.localization);
  if (!localization) return Unexpected{localization.error()};
  auto line = planning::prepare(params.planning, *map);
  if (!line) return Unexpected{line.error()};
  auto gains = control::prepare(params.control);
  if (!gains) return Unexpected{gains.error()};
  CarParams checked = params;
  checked.localization = *localization;
  return Setup{checked, *std::move(map), *datum, *std::move(line), *gains};
}

}  // namespace pitwall::pipeline
