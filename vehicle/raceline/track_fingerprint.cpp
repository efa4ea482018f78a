// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/track_fingerprint.hpp"

#include <initializer_list>

#include "protocol/bits/sha256.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::raceline {

std::string fingerprint_of(const world::TrackDescription& track) {
  std::string text = track.name + "\n";
  const auto row = [&](std::initializer_list<double> numbers) {
    for (const double number : numbers) text += shortest(number) + " ";
    text += "\n";
  };
  row({track.length_m, track.datum_latitude_deg, track.datum_longitude_deg, track.datum_height_m});
  row({track.start_x_m, track.start_y_m, track.start_yaw_rad});
  if (track.pit)
    row({track.pit->entry_s_m, track.pit->exit_s_m, track.pit->offset_m, track.pit->width_m,
         track.pit->speed_limit_mps});
  for (const world::TrackKnot& k : track.knots)
    row({k.s_m, k.curvature_per_m, k.bank_rad, k.width_left_m, k.width_right_m});
  bits::Sha256 hash;
  hash.update(as_bytes(text));
  return bits::to_hex(hash.digest());
}

}  // namespace pitwall::raceline
