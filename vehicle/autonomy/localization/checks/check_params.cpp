// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/check_params.hpp"

namespace pitwall::localization {

std::optional<Problem> illegal(const CheckParams& params) {
  return world::first_illegal(kCheckRanges, params, "checks.");
}

}  // namespace pitwall::localization
