// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/attempt.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::state {
namespace {

// Values of enumerations, as telemetry/registry/labels.hpp has them.
constexpr double kNoFlag = 0.0, kWavingGreen = 5.0, kUnknownTrackFlag = 7.0;
constexpr double kDefenderFlag = 9.0, kAttackerFlag = 10.0, kUnknownVehicleFlag = 11.0;

// Nobody knows what race control shows.
bool says_nothing(double track_flag) {
  return std::isnan(track_flag) || track_flag == kNoFlag || track_flag == kUnknownTrackFlag;
}

}  // namespace

std::optional<Role> role_of_flag(double vehicle_flag) {
  if (std::isnan(vehicle_flag) || vehicle_flag == kUnknownVehicleFlag) return std::nullopt;
  if (vehicle_flag == kDefenderFlag) return Role::kDefender;
  return vehicle_flag == kAttackerFlag ? Role::kAttacker : Role::kNone;
}

void AttemptTracker::receive(const RaceSample& sample, double attempt_laps, Instant at) {
  const bool runs = state_ == AttemptState::kRunning || state_ == AttemptState::kUsedUp ||
                    state_ == AttemptState::kPassed;
  const std::optional<Role> role = role_of_flag(sample.vehicle_flag);
  const bool waving = sample.track_flag == kWavingGreen;
  const bool goes_on = (waving || says_nothing(sample.track_flag)) && role.value_or(role_) == role_;
  if (runs && other_since_ && at - *other_since_ >= kEndsAfter) {
    // What was reached stays to be read; an attempt cut short says so.
    if (state_ == AttemptState::kRunning) state_ = AttemptState::kEnded;
    role_ = Role::kNone;
  }
  const bool may_begin = !runs || role_ == Role::kNone;
  if (may_begin && waving && role && *role != Role::kNone) {
    begin(*role);
  } else if (!may_begin) {
    if (goes_on) other_since_.reset();
    if (!goes_on && !other_since_) other_since_ = at;
    follow_laps(sample, at);
  }
  if (std::isfinite(sample.lap)) lap_ = sample.lap;
  if (std::isfinite(sample.station_m)) station_m_ = sample.station_m;
  if (std::isfinite(sample.lap) || std::isfinite(sample.station_m)) placed_ = at;
  if (role_ == Role::kNone) return;
  if (state_ == AttemptState::kRunning && passes(sample)) state_ = AttemptState::kPassed;
  if (state_ == AttemptState::kRunning && laps_ >= attempt_laps) state_ = AttemptState::kUsedUp;
}

void AttemptTracker::begin(Role role) {
  ++number_;
  state_ = AttemptState::kRunning;
  role_ = role;
  laps_ = 0.0;
  was_behind_ = false;
  other_since_.reset();
}

// Half a lap away, ahead turns into behind without a pass.
bool AttemptTracker::passes(const RaceSample& sample) {
  if (sample.gap_ahead_m >= 0.0) was_behind_ = sample.gap_ahead_m <= kNear_m;
  return role_ == Role::kAttacker && was_behind_ && std::isnan(sample.gap_ahead_m) &&
         sample.gap_behind_m >= kPassGap_m && sample.gap_behind_m <= kNear_m;
}

void AttemptTracker::follow_laps(const RaceSample& sample, Instant at) {
  const double driven = driven_laps(sample, at);
  if (!std::isnan(driven)) laps_ = std::max(0.0, laps_ + driven);
}

// Since the newest sample; not a number where nobody can tell.
double AttemptTracker::driven_laps(const RaceSample& sample, Instant at) const {
  const double laps = sample.lap - lap_;
  const double along = (sample.station_m - station_m_) / sample.course_m;
  if (std::isnan(along)) return laps < 0.0 ? kUnset : laps;
  if (at - placed_ < kByStation) return along - std::round(along);
  if (std::isnan(laps) || laps < 0.0) return along - std::floor(along);
  return laps + along;
}

Attempt AttemptTracker::attempt() const {
  if (number_ == 0) return {};
  return {.number = static_cast<double>(number_), .laps = laps_, .state = state_};
}

}  // namespace pitwall::state
