// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/pass.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::planning {
namespace {

constexpr double kUnseenMost_s = 1.0;                      // of a rival that a pass begins at
constexpr double kRisk_s = 0.2;                            // a risk must last so long
constexpr double kAsideLeast_s = 1.0, kAsideMost_s = 3.0;  // over which a drift is believed
constexpr double kRiskClear_m = 2.6;                       // 1.93 m of car and a margin
constexpr double kGiveWay_mps = 3.0;

void enter(PassState& s, PassPhase phase, PassBar bar, Instant now) {
  s.phase = phase;
  s.bar = bar;
  s.since = now;
  s.risk_since = {};
}

// The line with most room beside the rival, among those that bring us past it.
std::size_t best_way(const PassParams& p, const PassInputs& in, PassBar& bar) {
  std::size_t best = 0;
  bar = PassBar::kNoLine;
  for (std::size_t i = 0; i < in.ways.size(); ++i) {
    if (in.ways[i].beside_m < p.side_clear_m) continue;
    if (!(in.ways[i].gained_m >= p.complete_gap_m)) {
      if (bar == PassBar::kNoLine) bar = PassBar::kTooSlow;
      continue;
    }
    if (bar == PassBar::kNone && in.ways[i].beside_m <= in.ways[best].beside_m) continue;
    best = i;
    bar = PassBar::kNone;
  }
  return best;
}

// True once the rival has been on a course into our line, before we are past it, for a while.
bool closes(const PassParams& p, PassState& s, const PassInputs& in, Instant now) {
  const Rival& rival = in.rival;
  const double closing_mps = std::max(in.speed_mps - rival.speed_mps, 1.0);
  const double past_s = (p.side_gap_m - rival.gap_m) / closing_mps;
  const double aside_s = std::clamp(past_s, kAsideLeast_s, kAsideMost_s);
  const double beside_m = std::abs(rival.n_m + rival.drift_mps * aside_s - in.line_n_m);
  if (!(beside_m < kRiskClear_m)) {
    s.risk_since = {};
    return false;
  }
  if (s.risk_since == Instant{}) s.risk_since = now;
  return (now - s.risk_since).seconds() >= kRisk_s;
}

// Whether braking now keeps the car behind; beyond that point the quicker way out is ahead.
bool can_stay_behind(const PassParams& p, const PassState& s, const PassInputs& in) {
  constexpr double kReaction_s = 0.6;
  const double closing_mps = std::max(in.speed_mps - in.rival.speed_mps, 0.0);
  const double gained_m = closing_mps * (kReaction_s + 0.5 * closing_mps / p.brake_mps2);
  return !s.ahead && in.rival.gap_m + gained_m < -p.side_gap_m;
}

void from_trail(const PassParams& p, PassState& s, const PassInputs& in, Instant now) {
  if (!in.rival.known || s.ahead) return enter(s, PassPhase::kFree, PassBar::kNone, now);
  if (!in.may_pass) {
    s.bar = PassBar::kNotAllowed;
    return;
  }
  if ((now - in.rival.measured_at).seconds() > kUnseenMost_s) {
    s.bar = PassBar::kNotSeen;
    return;
  }
  const std::size_t way = best_way(p, in, s.bar);
  if (s.bar != PassBar::kNone || (now - s.since).seconds() < p.dwell_s) return;
  enter(s, PassPhase::kPass, PassBar::kNone, now);
  s.line = way;
  s.pass_mps = 0.0;
}

void from_pass(const PassParams& p, PassState& s, const PassInputs& in, Instant now) {
  if (!in.rival.known || in.rival.gap_m >= p.complete_gap_m) {
    s.passed = in.rival.known;
    return enter(s, PassPhase::kAhead, PassBar::kNone, now);
  }
  if (!in.may_pass) {
    // The most restrictive reading: who is not well ahead gives way.
    const bool well_ahead = in.rival.gap_m > 0.5 * p.complete_gap_m;
    return enter(s, well_ahead ? PassPhase::kAhead : PassPhase::kYield, PassBar::kNotAllowed, now);
  }
  if (closes(p, s, in, now) && can_stay_behind(p, s, in))
    enter(s, PassPhase::kYield, PassBar::kRivalCloses, now);
}

void from_ahead(const PassParams& p, PassState& s, const PassInputs& in, Instant now) {
  if (in.rival.known && !s.ahead) return enter(s, PassPhase::kYield, s.bar, now);
  if (in.rival.known && in.rival.gap_m < p.complete_gap_m - p.side_gap_m && s.line != 0) return;
  if (s.line == 0 && in.has_merged) return enter(s, PassPhase::kFree, PassBar::kNone, now);
  s.line = 0;
}

void from_yield(const PassParams& p, PassState& s, const PassInputs& in, Instant now) {
  const bool behind = in.rival.known && in.rival.gap_m <= -0.5 * p.trail_gap_m;
  if (in.rival.known && !behind) return;
  s.line = 0;
  enter(s, in.rival.known ? PassPhase::kTrail : PassPhase::kFree, s.bar, now);
}

}  // namespace

AttemptChoice choose_attempt(AttemptChoice before, rules::FuelState fuel, bool attacks,
                             bool waving) {
  if (!attacks) return AttemptChoice::kOpen;
  if (before == AttemptChoice::kDeclined || fuel == rules::FuelState::kHomeNow)
    return AttemptChoice::kDeclined;
  if (before == AttemptChoice::kOpen && fuel == rules::FuelState::kNoAttempt)
    return AttemptChoice::kDeclined;
  return waving ? AttemptChoice::kCommitted : before;
}

PassState advance(const PassParams& p, const PassState& state, const PassInputs& in, Instant now) {
  PassState s = state;
  s.rival = in.rival;
  if (!in.may_pass) s.passed = false;
  if (!in.rival.known) s.ahead = false;
  if (in.rival.known && in.rival.gap_m > p.side_gap_m) s.ahead = true;
  if (in.rival.known && in.rival.gap_m < -p.side_gap_m) s.ahead = false;
  switch (s.phase) {
    case PassPhase::kFree:
      if (in.rival.known && in.rival.gap_m < -p.side_gap_m)
        enter(s, PassPhase::kTrail, PassBar::kNone, now);
      break;
    case PassPhase::kTrail:
      from_trail(p, s, in, now);
      break;
    case PassPhase::kPass:
      from_pass(p, s, in, now);
      break;
    case PassPhase::kAhead:
      from_ahead(p, s, in, now);
      break;
    case PassPhase::kYield:
      from_yield(p, s, in, now);
      break;
  }
  const bool passes = s.phase == PassPhase::kPass || s.phase == PassPhase::kAhead;
  if (!passes) {
    s.pass_mps = kUnset;
  } else if (in.rival.known && s.phase == PassPhase::kPass) {
    const double wanted_mps = std::max(in.base_mps, in.rival.speed_mps) + p.pass_extra_mps;
    s.pass_mps = std::isfinite(s.pass_mps) ? std::max(s.pass_mps, wanted_mps) : wanted_mps;
  }
  return s;
}

double pass_speed_mps(const PassParams& p, const PassState& s, const PassInputs& in) {
  double speed_mps = in.base_mps;
  const bool seeks = in.may_close && s.phase == PassPhase::kFree && !s.rival.known && !s.passed;
  if (seeks) speed_mps = in.base_mps + p.close_extra_mps;
  if (in.may_close && s.phase == PassPhase::kTrail)
    speed_mps = std::max(in.base_mps, s.rival.speed_mps) + p.close_extra_mps;
  if (in.may_close && std::isfinite(s.pass_mps)) speed_mps = s.pass_mps;
  if (s.phase == PassPhase::kYield && s.rival.known)
    speed_mps = std::min(in.base_mps, std::max(s.rival.speed_mps - kGiveWay_mps, 0.0));
  return std::min(speed_mps, in.most_mps);
}

double follow_mps(const PassParams& p, double brake_mps2, double ahead_m, double car_mps,
                  bool trails) {
  const double room_m = std::max(ahead_m - kLeastGap_m, 0.0);
  const double met_mps = std::sqrt(car_mps * car_mps + 2.0 * brake_mps2 * room_m);
  const double stop_short_mps = ahead_m < kLeastGap_m ? 0.5 * car_mps : met_mps;
  if (!trails) return stop_short_mps;
  const double wanted_mps = car_mps + p.trail_gain_per_s * (ahead_m - p.trail_gap_m);
  return std::clamp(wanted_mps, 0.0, stop_short_mps);
}

}  // namespace pitwall::planning
