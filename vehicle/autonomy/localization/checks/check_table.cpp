// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/check_table.hpp"

namespace pitwall::localization {

Judged judge(const Evidence& evidence, const CheckParams& params, world::MonitorSet off) {
  Judged out;
  for (const CheckRow& row : kChecks) {
    if ((row.sources & only(evidence.source)) == 0) continue;
    if (row.monitor && off.has(*row.monitor)) continue;
    if (!row.fails(evidence, params)) continue;
    if (row.monitor) out.seen.add(*row.monitor);
    if (row.refuses && out.gate == Gate::kAccepted) out.gate = row.reason;
    if (!row.monitor) break;
  }
  return out;
}

}  // namespace pitwall::localization
