// Reader of a track as the teams keep it: a CSV with one row per point of a reference line, in the
// order of driving, once round. Separator ',' or ';'. The header is a line of names, also behind a
// '#', as TUM's racetrack-database and its trajectory files have it; other '#' lines are comments.
//
//   name                                  unit  what
//   x_m, y_m         (x_ref_m, y_ref_m)    m    place, east and north of the datum
//   s_m              (s_ref_m)             m    station; the only place where x and y are missing
//   curvature_per_m  (kappa_ref_radpm)    1/m   positive to the left; with s_m instead of x, y
//   width_right_m    (w_tr_right_m)        m    reference line to right wall
//   width_left_m     (w_tr_left_m)         m    reference line to left wall
//   bank_deg or bank_rad                        optional: positive where the left side is lower
//   banking_rad                           rad   the same as TUM writes it: negative there
//   z_m or height_m                        m    optional
//   x_normvec_m, y_normvec_m, alpha_m, s_racetraj_m, psi_racetraj_rad, kappa_racetraj_radpm,
//   vx_racetraj_mps, ax_racetraj_mps2, psi_ref_rad, dkappa_ref_radpm2: TUM's, read over
//
//   out    rows with the numbers of their lines; what is not in the file is NaN in every row
//   errors "file:line": no or an unknown or a repeated header, a column missing, a wrong count of
//          fields, what is no finite number, a width that is not positive, two rows at one place,
//          a station that does not increase, fewer than kRowsMin rows, more than kRowsMax, a file
//          beyond kMaxCsvBytes
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
inline constexpr std::size_t kRowsMin = 20;      // fewer describe no track
inline constexpr std::size_t kRowsMax = 20'000;  // walls are compared with each other

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
  bool has_place = false;  // x and y; else station and curvature
  bool has_bank = false, has_height = false;
};

Result<TrackCsv, Problem> read_track_csv(std::string_view text, const std::string& name);

std::string place_of(const TrackCsv& csv, std::size_t row);  // "file:line"

}  // namespace pitwall::track_file
