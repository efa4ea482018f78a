// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/params.hpp"

namespace pitwall::tracking {

Result<Params, Problem> checked(const Params& params) {
  if (auto problem = world::first_illegal(kRanges, params)) return Unexpected{*problem};
  if (auto problem = world::first_illegal(kRoadRanges, params.road, "road."))
    return Unexpected{*problem};
  if (auto problem = world::first_illegal(kPaperRanges, params.paper, "paper."))
    return Unexpected{*problem};
  return params;
}

}  // namespace pitwall::tracking
