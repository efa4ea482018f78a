// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/check_params.hpp"

#include <string>

namespace pitwall::localization {

std::optional<Problem> illegal(const CheckParams& params) {
  for (const CheckRange& range : kCheckRanges) {
    const double value = params.*range.value;
    if (value >= range.least && value <= range.most) continue;
    return Problem{"checks." + std::string{range.name},
                   "is " + std::to_string(value) + ", must be within " +
                       std::to_string(range.least) + " and " + std::to_string(range.most)};
  }
  return std::nullopt;
}

}  // namespace pitwall::localization
