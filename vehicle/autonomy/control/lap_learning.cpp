// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/lap_learning.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pitwall::control {
namespace {

constexpr double kFrom_mps = 12.0;       // below, a lap is no pattern
constexpr double kNarrowest_bins = 0.8;  // of the weights: a parabola needs three bins
constexpr std::size_t kPassed = 2 * kLapReach + 1;

// Value and derivatives of a parabola through the bins around the one that is taught.
struct Parabola {
  double value = 0.0, rate_per_s = 0.0, accel_per_s2 = 0.0;
};

// The bin to be taught is the middle one of those passed; `lead_s` is after it.
template <class Of>
Parabola parabola(const LapState& s, double bin_s, double lead_s, double smooth_s, const Of& of) {
  const double width_s = std::max(smooth_s, kNarrowest_bins * bin_s);
  std::array<double, 5> m{};  // sums of w t^i
  std::array<double, 3> b{};  // sums of w t^i y
  for (std::size_t back = 0; back < kPassed; ++back) {
    const double t = (static_cast<double>(kLapReach) - static_cast<double>(back)) * bin_s - lead_s;
    const double u = t / width_s, w = std::exp(-0.5 * u * u);
    const double y = of(s.passed[(s.newest + kPassed - back) % kPassed]);
    double power = w;
    for (std::size_t i = 0; i < m.size(); ++i, power *= u) {
      m[i] += power;
      if (i < b.size()) b[i] += power * y;
    }
  }
  const double c0 = m[2] * m[4] - m[3] * m[3], c1 = m[2] * m[3] - m[1] * m[4],
               c2 = m[1] * m[3] - m[2] * m[2];
  const double d1 = m[0] * m[4] - m[2] * m[2], d2 = m[1] * m[2] - m[0] * m[3],
               e2 = m[0] * m[2] - m[1] * m[1];
  const double det = m[0] * c0 + m[1] * c1 + m[2] * c2;
  if (!(det > 0.0)) return {};
  return {(c0 * b[0] + c1 * b[1] + c2 * b[2]) / det,
          (c1 * b[0] + d1 * b[1] + d2 * b[2]) / det / width_s,
          2.0 * (c2 * b[0] + d2 * b[1] + e2 * b[2]) / det / (width_s * width_s)};
}

// Angle that leaves an error: L of the contract.
double angle_of(const steering::Params& p, const LqrGains& gains, double v_mps,
                const Parabola& error) {
  const LqrGain gain = gain_at(gains, v_mps);
  const double h = std::accumulate(gain.sent.begin(), gain.sent.end(), 1.0 + gain.wheel);
  const double accel = steering::angle_per_curvature_m(p, {}, v_mps, 0.0) / (v_mps * v_mps);
  return (gain.error[0] * error.value +
          (gain.error[1] + gain.error[2] / v_mps) * error.rate_per_s) /
             h +
         accel * error.accel_per_s2;
}

void teach(const LapParams& p, const steering::Params& steering, const LqrGains& gains,
           LapState& s) {
  const std::size_t bin = (s.bin + kLapBins - 1 - kLapReach) % kLapBins;
  const LapBin& at = s.passed[(s.newest + kPassed - kLapReach) % kPassed];
  const double bin_s = s.length_m / static_cast<double>(kLapBins) / at.speed_mps;
  const Parabola error =
      parabola(s, bin_s, p.lead_s, p.smooth_s, [](const LapBin& b) { return b.error_m; });
  const Parabola applied =
      parabola(s, bin_s, 0.0, p.smooth_s, [](const LapBin& b) { return b.applied_rad; });
  const double angle_rad =
      (1.0 - p.forget) * applied.value - p.gain * angle_of(steering, gains, at.speed_mps, error);
  s.angle_rad[bin] = static_cast<float>(std::clamp(angle_rad, -p.angle_max_rad, p.angle_max_rad));
  s.speed_mps[bin] = static_cast<float>(at.speed_mps);
}

// Of what a bin holds, at this speed.
double used_rad(const LapParams& p, const LapState& s, std::size_t bin, double v_mps) {
  const double taught_mps = static_cast<double>(s.speed_mps[bin]);
  if (!(taught_mps > 0.0)) return 0.0;
  const double off = std::abs(v_mps / taught_mps - 1.0) / p.speed_share;
  return std::clamp(2.0 - 2.0 * off, 0.0, 1.0) * static_cast<double>(s.angle_rad[bin]);
}

double table_rad(const LapParams& p, const LapState& s, double place, double v_mps) {
  constexpr auto kBins = static_cast<double>(kLapBins);
  const double from = place - 0.5 < 0.0 ? place - 0.5 + kBins : place - 0.5;
  const auto low = std::min(static_cast<std::size_t>(from), kLapBins - 1);
  return std::lerp(used_rad(p, s, low, v_mps), used_rad(p, s, (low + 1) % kLapBins, v_mps),
                   from - static_cast<double>(low));
}

// Number of the bin and what of it lies behind the car.
double place_of(const LapInputs& in) {
  constexpr auto kBins = static_cast<double>(kLapBins);
  const double laps = in.s_m / in.length_m;
  return std::min((laps - std::floor(laps)) * kBins, std::nextafter(kBins, 0.0));
}

void begin(LapState& s, double length_m) {
  const double applied_rad = s.applied_rad;
  s = {};
  s.length_m = length_m;
  s.applied_rad = applied_rad;
}

void pause(LapState& s) {
  s.run = s.ticks = 0;
  s.whole = false;
}

// A bin that was passed in whole counts; one that follows no other begins a new run.
void leave(LapState& s) {
  const double share = 1.0 / static_cast<double>(s.ticks);
  s.newest = (s.newest + 1) % kPassed;
  s.passed[s.newest] = {s.sums.error_m * share, s.sums.applied_rad * share,
                        s.sums.speed_mps * share};
  s.run = s.whole ? s.run + 1 : 0;
}

// True where the bins around one that is to be taught have been passed.
bool enter(LapState& s, std::size_t bin) {
  if (s.ticks > 0 && bin == s.bin) return false;
  const bool next = s.ticks > 0 && bin == (s.bin + 1) % kLapBins;
  if (next)
    leave(s);
  else
    s.run = 0;
  s.bin = bin, s.whole = next, s.ticks = 0, s.sums = {};
  return s.run >= kPassed;
}

void add(LapState& s, const LapInputs& in) {
  ++s.ticks;
  s.sums.error_m += in.lateral_m;
  s.sums.applied_rad += s.applied_rad;
  s.sums.speed_mps += in.speed_mps;
}

}  // namespace

double learn_lap(const LapParams& p, const steering::Params& steering, const LqrGains& gains,
                 LapState& s, const LapInputs& in, Duration dt) {
  const bool drives = p.gain > 0.0 && in.drives && in.length_m > 0.0 && in.speed_mps > kFrom_mps &&
                      std::isfinite(in.s_m + in.length_m + in.speed_mps + in.lateral_m);
  const bool teaches = drives && in.teaches;
  if (drives && s.length_m != in.length_m) begin(s, in.length_m);
  if (!teaches) pause(s);
  double wanted_rad = 0.0;
  if (drives) {
    const double place = place_of(in);
    if (teaches && enter(s, static_cast<std::size_t>(place))) teach(p, steering, gains, s);
    wanted_rad = table_rad(p, s, place, in.speed_mps);
  }
  const double step_rad = p.slew_rad_per_s * steering::tick_s(dt);
  s.applied_rad += std::clamp(wanted_rad - s.applied_rad, -step_rad, step_rad);
  if (teaches) add(s, in);
  return s.applied_rad;
}

}  // namespace pitwall::control
