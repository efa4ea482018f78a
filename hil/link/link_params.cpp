// SPDX-License-Identifier: Apache-2.0
#include "hil/link/link_params.hpp"

#include "protocol/vocabulary/check.hpp"

namespace pitwall::link {

LinkParams bursty(double loss, Duration mean_fade, double rate_bytes_per_s, Duration delay) {
  CHECK(loss >= 0.0 && loss < 1.0);
  LinkParams params;
  params.rate_bytes_per_s = rate_bytes_per_s;
  params.delay = delay;
  if (loss > 0.0) {
    params.fades.mean_bad = mean_fade;
    params.fades.mean_good = from_seconds(mean_fade.seconds() * (1.0 - loss) / loss);
  }
  return params;
}

}  // namespace pitwall::link
