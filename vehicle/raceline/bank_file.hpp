// The file of a bank of racelines: JSON, one point a line.
//   in     a bank; the text of a file and its name
//   out    the text; the bank, whose every line has passed check_raceline() again
//   format {"kind", "version", "track", "track_fingerprint", "tyre_share", "lines": [{"name",
//          "region", "length_m", "lap_s", "points": [[x_m, y_m, yaw_rad, curvature_per_m,
//          bank_rad, speed_mps, accel_mps2, gear, time_s], ...]}, ...]}; places to 1e-7 m, angles
//          to 1e-9 rad, speeds to 1e-6 m/s. A line without a speed profile has no
//          "lap_s", and five numbers in each point
//   errors Problem with the file's name: no bank, another version, a bank of another track or of
//          another revision of it (by its fingerprint), no line, two of one name, and what
//          check_raceline() refuses
//   cost   O(bytes); start-up only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/raceline/lanes/raceline.hpp"
#include "vehicle/raceline/line_check.hpp"

namespace pitwall::raceline {

inline constexpr std::size_t kMaxBankBytes = std::size_t{64} << 20U;

std::string to_json(const RacelineBank& bank);

Result<RacelineBank, Problem> read_bank(std::string_view text, const std::string& name,
                                        const world::TrackDescription& description,
                                        const world::TrackMap& track, const CarLimits& car);

}  // namespace pitwall::raceline
