// Table of all checks of a sample that is not excluded: reason, monitor, checked sources and
// condition. The rows are evaluated from top to bottom; the first row that a sample fails is its
// verdict, and the monitor of every failed row reports.
//   in     Evidence: the facts about one sample; a number that does not apply is NaN, and no
//          condition is true for a NaN
//   out    the verdict, and the monitors with a finding
//   invariants
//          a row without a monitor checks the form: a sample that fails it is always refused and
//          not checked further. A row whose monitor is disabled is skipped
//   units  position m, velocity m/s, angles rad
//   cost   O(rows); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/localization/checks/check_params.hpp"
#include "vehicle/autonomy/localization/checks/verdict.hpp"
#include "vehicle/world/monitor.hpp"

namespace pitwall::localization {

struct Evidence {
  Source source = Source::kPosition;
  // Form.
  bool known_unit = true, finite = true, plausible = true;
  double least_sigma = kUnset;  // smallest sigma of the sample
  // Time.
  double age_s = kUnset, window_s = kUnset;  // age, and the largest that the filter accepts
  double after_newest_s = kUnset, spacing_s = kUnset;
  bool same_content = false;  // identical to the previous sample of the stream
  double speed_mps = kUnset;  // of the car, from the filter
  // Solution.
  bool solved = true;
  double rank = kUnset;
  double sigma = kUnset, sigma_max = kUnset;
  double other_sigma = kUnset;  // sigma of the other unit, while that one is in use
  double height_sigma_m = kUnset;
  double differential_age_s = kUnset, solution_age_s = kUnset;
  double baseline_error_m = kUnset;
  bool receiver_well = true, other_well = false;
  // Relative to the prediction.
  double residual = kUnset;  // magnitude
  double jump_min = kUnset, jump_sigma_max = kUnset;
  double course_error_rad = kUnset;
  // Relative to the other unit: difference of the two residuals, the allowed difference, and the
  // drift of each unit (drift_watch.hpp).
  double apart = kUnset, apart_max = kUnset;
  double stray = kUnset, other_stray = kUnset;
};

using Sources = std::uint8_t;  // one bit each
constexpr Sources only(Source s) { return static_cast<Sources>(1U << static_cast<unsigned>(s)); }
constexpr Sources operator+(Source a, Source b) { return static_cast<Sources>(only(a) | only(b)); }
constexpr Sources operator+(Sources a, Source b) { return static_cast<Sources>(a | only(b)); }

struct CheckRow {
  Gate reason;
  std::optional<world::Monitor> monitor;
  Sources sources;
  bool refuses;  // false: the monitor reports, the sample passes
  bool (*fails)(const Evidence& e, const CheckParams& p);
};

namespace checks {
using enum Source;
inline constexpr Sources kAll = kPosition + kVelocity + kHeading + kImu + kAttitude;
inline constexpr Sources kFixes = kPosition + kVelocity + kHeading;
using E = const Evidence&;
using P = const CheckParams&;
}  // namespace checks

inline constexpr auto kChecks = [] {
  using enum Gate;
  using enum Source;
  using checks::E, checks::P, checks::kAll, checks::kFixes;
  constexpr std::optional<world::Monitor> kForm = std::nullopt;
  constexpr auto kStamp = world::Monitor::kStamp, kAge = world::Monitor::kStreamAge,
                 kSolution = world::Monitor::kSolution, kInnovation = world::Monitor::kInnovation,
                 kUnits = world::Monitor::kUnitAgreement;
  constexpr bool kRefuse = true, kNotice = false;
  return std::to_array<CheckRow>({
      {kUnknownUnit, kForm, kAll, kRefuse, [](E e, P) { return !e.known_unit; }},
      // A sample without a solution contains zeros or nothing: this row gives the true reason
      // first.
      {kNotSolved, kSolution, kAll, kRefuse, [](E e, P) { return !e.solved; }},
      {kNotFinite, kForm, kAll, kRefuse, [](E e, P) { return !e.finite; }},
      {kNegativeVariance, kForm, kAll, kRefuse, [](E e, P) { return e.least_sigma < 0.0; }},
      {kImplausible, kForm, kAll, kRefuse, [](E e, P) { return !e.plausible; }},

      {kFromTheFuture, kStamp, kAll, kRefuse, [](E e, P p) { return -e.age_s > p.future_max_s; }},
      {kTooOld, kAge, kAll, kRefuse, [](E e, P) { return e.age_s > e.window_s; }},
      {kRanBack, kStamp, kAll, kRefuse,
       [](E e, P p) { return -e.after_newest_s > p.reorder_max_s; }},
      {kRepeated, kStamp, kAll, kRefuse, [](E e, P p) { return e.spacing_s < p.spacing_min_s; }},
      {kFrozen, kStamp, kAll, kRefuse,
       [](E e, P p) { return e.same_content && e.speed_mps > p.frozen_speed_min_mps; }},

      {kNotSolved, kSolution, kAll, kRefuse, [](E e, P p) { return e.rank < p.position_rank_min; }},
      {kTooUncertain, kSolution, kAll, kRefuse, [](E e, P) { return e.sigma > e.sigma_max; }},
      {kTooUncertain, kSolution, only(kPosition), kRefuse,
       [](E e, P p) { return e.height_sigma_m > p.height_sigma_max_m; }},
      {kTooUncertain, kSolution, only(kPosition), kRefuse,
       [](E e, P p) { return e.sigma > p.sigma_ratio_max * e.other_sigma; }},
      {kOldCorrections, kSolution, kFixes, kRefuse,
       [](E e, P p) {
         return e.differential_age_s > p.differential_age_max_s ||
                e.solution_age_s > p.solution_age_max_s;
       }},
      {kWrongBaseline, kSolution, only(kHeading), kRefuse,
       [](E e, P p) { return std::abs(e.baseline_error_m) > p.baseline_tolerance_m; }},
      {kReceiverError, kSolution, kFixes, kRefuse,
       [](E e, P) { return !e.receiver_well && e.other_well; }},

      {kOutlier, kInnovation, kFixes + kAttitude, kRefuse,
       [](E e, P) { return e.residual > e.jump_min && e.residual > e.jump_sigma_max; }},
      {kDisagrees, kUnits, kFixes, kNotice, [](E e, P) { return e.apart > e.apart_max; }},
      {kDisagrees, kUnits, kFixes, kRefuse,
       [](E e, P p) { return e.apart > e.apart_max && e.stray > p.worse_factor * e.other_stray; }},
      {kOffCourse, kUnits, kHeading + kAttitude, kRefuse,
       [](E e, P p) { return std::abs(e.course_error_rad) > p.course_max_rad; }},
  });
}();

struct Judged {
  Gate gate = Gate::kAccepted;
  world::MonitorSet seen{};
};
Judged judge(const Evidence& evidence, const CheckParams& params, world::MonitorSet off);

}  // namespace pitwall::localization
