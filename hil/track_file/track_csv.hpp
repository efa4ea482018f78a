// Reader of track CSV files as the teams keep them: one row per point of a reference line, in
// driving order, one lap. Separator ',' or ';'. The header is a line of names, also after a '#', as
// in TUM's racetrack-database and trajectory files; other '#' lines are comments.
//
//   name                                  unit  what
//   x_m, y_m         (x_ref_m, y_ref_m)    m    position, east and north of the datum
//   s_m              (s_ref_m)             m    station; replaces missing x and y
//   curvature_per_m  (kappa_ref_radpm)    1/m   positive to the left; with s_m instead of x, y
//   width_right_m    (w_tr_right_m)        m    reference line to right wall
//   width_left_m     (w_tr_left_m)         m    reference line to left wall
//   bank_deg or bank_rad                        optional: positive where the left side is lower
//   banking_rad                           rad   the same with the opposite sign, as TUM writes it
//   z_m or height_m                        m    optional
//   x_normvec_m, y_normvec_m, alpha_m, s_racetraj_m, psi_racetraj_rad, kappa_racetraj_radpm,
//   vx_racetraj_mps, ax_racetraj_mps2, psi_ref_rad, dkappa_ref_radpm2: columns of TUM, ignored
//
//   out    rows with their line numbers; a quantity that is not in the file is NaN in every row
//   errors "file:line": a missing, unknown or repeated header, a missing column, a wrong number of
//          fields, a value that is not a finite number, a width that is not positive, two rows at
//          one place, a station that does not increase, fewer than kRowsMin rows, more than
//          kRowsMax, a file larger than kMaxCsvBytes
//   cost   O(bytes)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::track_file {

inline constexpr std::size_t kMaxCsvBytes = std::size_t{8} << 20U;
inline constexpr std::size_t kRowsMin = 20;      // fewer do not describe a track
inline constexpr std::size_t kRowsMax = 20'000;  // the check of the walls is O(rows^2)

struct CsvRow {
  std::size_t line = 0;
  double x_m = kUnset, y_m = kUnset;
  double s_m = kUnset, curvature_per_m = kUnset;
  double width_right_m = kUnset, width_left_m = kUnset;
  double bank_rad = kUnset, height_m = kUnset;
};

struct TrackCsv {
  std::string name;  // of the file, for messages
  std::vector<CsvRow> rows;
  bool has_place = false;  // true: x and y; false: station and curvature
  bool has_bank = false, has_height = false;
};

Result<TrackCsv, Problem> read_track_csv(std::string_view text, const std::string& name);

std::string place_of(const TrackCsv& csv, std::size_t row);  // "file:line"

}  // namespace pitwall::track_file
