// Summary of the tracking of other cars, for the summary of a run.
//   in     counters of the tracker; the cars that it knew at the end
//   out    JSON object: each count by its name; `cars`, with place and speed
//   units  m, m/s; frame Map
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "vehicle/autonomy/tracking/admission.hpp"
#include "vehicle/world/opponent.hpp"

namespace pitwall::io {

std::string tracking_json(const tracking::Counters& counters, const world::Opponents& opponents);

}  // namespace pitwall::io
