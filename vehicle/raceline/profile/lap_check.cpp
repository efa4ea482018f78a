// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/profile/lap_check.hpp"

#include <cmath>
#include <optional>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::raceline {
namespace {

// A file rounds speeds to micrometres a second and curvature to 1e-9 1/m.
constexpr double kSpeedOff_mps = 1e-3;
constexpr double kAccelOff_mps2 = 0.02;
constexpr double kTimeOff_s = 1e-3;

class LapCheck {
 public:
  LapCheck(const Raceline& line, std::span<const RoadStep> road,
           const envelope::EnvelopeTable& table)
      : line_(line), road_(road), table_(table), n_(line.points.size()) {}

  Result<LapFigures, Problem> run() {
    if (line_.lap.size() != n_ || road_.size() != n_ || !std::isfinite(line_.lap_s))
      return refuse(line_.name, "has no speed profile");
    figures_.lap_s = line_.lap_s;
    double time_s = 0.0;
    for (std::size_t i = 0; i < n_; ++i)
      if (auto problem = point(i)) return Unexpected{*std::move(problem)};
    for (std::size_t i = 0; i < n_; ++i)
      if (auto problem = step(i, time_s)) return Unexpected{*std::move(problem)};
    if (!(std::abs(time_s - line_.lap_s) <= kTimeOff_s))
      return refuse(line_.name, formatted("the lap is said to take %.3f s, its speeds take %.3f s",
                                          line_.lap_s, time_s));
    return figures_;
  }

 private:
  double s_m(std::size_t i) const { return line_.spacing_m() * static_cast<double>(i); }
  const LapPoint& at(std::size_t i) const { return line_.lap[i % n_]; }
  envelope::RoadPlace place(std::size_t i) const {
    const RoadStep& road = road_[i % n_];
    return table_.place(road.curvature_per_m, road.bank_rad);
  }
  Problem problem(std::size_t i, const std::string& what) const {
    return {formatted("%s: s = %.1f m", line_.name.c_str(), s_m(i)), what};
  }

  std::optional<Problem> point(std::size_t i) {
    const double v = at(i).speed_mps;
    if (!std::isfinite(v + at(i).accel_mps2 + at(i).time_s) || !(v > 0.0))
      return problem(i, "a speed, an acceleration or a time is missing or not a number");
    const envelope::RoadPlace here = place(i);
    const double lateral = std::abs(envelope::EnvelopeTable::lateral_mps2(here, v));
    const double most = table_.lateral_max_mps2(here, v);
    const double corner_mps = table_.corner_speed_mps(here);
    if (!(lateral <= most) && !(v <= corner_mps + kSpeedOff_mps))
      return problem(i, formatted("a speed of %.3f m/s needs %.2f m/s2 across the road, the car "
                                  "carries %.2f m/s2: at most %.3f m/s",
                                  v, lateral, most, corner_mps));
    const double cap_mps = std::min(road_[i].cap_mps, table_.params().speed_max_mps);
    if (!(v <= cap_mps + kSpeedOff_mps))
      return problem(i, formatted("a speed of %.3f m/s, at most %.3f m/s", v, cap_mps));
    if (!(v >= figures_.speed_least.value)) figures_.speed_least = {v, s_m(i)};
    if (!(v <= figures_.speed_most.value)) figures_.speed_most = {v, s_m(i)};
    if (most > 0.0 && !(lateral / most <= figures_.lateral_use_most.value))
      figures_.lateral_use_most = {lateral / most, s_m(i)};
    return std::nullopt;
  }

  // What the car does from this point to the next.
  std::optional<Problem> step(std::size_t i, double& time_s) const {
    const double h_m = line_.spacing_m(), v = at(i).speed_mps, next = at(i + 1).speed_mps;
    const double accel = (next * next - v * v) / (2.0 * h_m);
    if (!(std::abs(accel - at(i).accel_mps2) <= kAccelOff_mps2))
      return problem(i, formatted("an acceleration of %.3f m/s2, the speeds have %.3f m/s2",
                                  at(i).accel_mps2, accel));
    if (!(std::abs(at(i).time_s - time_s) <= kTimeOff_s))
      return problem(i,
                     formatted("a time of %.3f s, the speeds take %.3f s", at(i).time_s, time_s));
    time_s += 2.0 * h_m / (v + next);
    const double drive = table_.longitudinal(place(i), v).accel_mps2;
    if (!(accel <= drive + kAccelOff_mps2) && accel > 0.0)
      return problem(i, formatted("an acceleration of %.2f m/s2 at %.2f m/s, the car has %.2f m/s2",
                                  accel, v, drive));
    const double brake = table_.longitudinal(place(i + 1), next).brake_mps2;
    if (!(-accel <= brake + kAccelOff_mps2))
      return problem(i, formatted("a deceleration of %.2f m/s2 at %.2f m/s, the car has %.2f m/s2",
                                  -accel, v, brake));
    return std::nullopt;
  }

  const Raceline& line_;
  std::span<const RoadStep> road_;
  const envelope::EnvelopeTable& table_;
  std::size_t n_;
  LapFigures figures_;
};

}  // namespace

Result<LapFigures, Problem> check_lap(const Raceline& line, std::span<const RoadStep> road,
                                      const envelope::EnvelopeTable& table) {
  return LapCheck{line, road, table}.run();
}

}  // namespace pitwall::raceline
