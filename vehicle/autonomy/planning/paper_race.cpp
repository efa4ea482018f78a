// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/paper_race.hpp"

#include <algorithm>

namespace pitwall::planning {

PassState advance_paper(const PassParams& p, const PassState& state, const PassInputs& in,
                        std::size_t lines, Instant now) {
  PassState s = state;
  s.rival = in.rival;
  s.bar = PassBar::kNone;
  s.pass_mps = kUnset;
  const PassPhase before = s.phase;
  s.ahead = in.rival.known && in.rival.gap_m > 0.0;
  if (!in.rival.known || s.ahead) {
    s.phase = in.rival.known && s.line != 0 ? PassPhase::kAhead : PassPhase::kFree;
    if (!in.rival.known || in.rival.gap_m >= p.complete_gap_m) s.line = 0;
    if (in.may_pass && s.line != 0) s.pass_mps = in.most_mps;
  } else if (in.may_pass && lines > 1) {
    s.phase = PassPhase::kPass;
    s.line = 1;
    s.pass_mps = std::max(in.base_mps, in.rival.speed_mps) + p.pass_extra_mps;
  } else {
    s.phase = PassPhase::kTrail;
    s.line = 0;
  }
  if (s.phase != before) s.since = now;
  return s;
}

}  // namespace pitwall::planning
