// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/track_yaml.hpp"

#include <string_view>

#include "hil/report/text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::track_file {
namespace {

// In double quotes everything but these two and control characters stands for itself.
std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + "\"";
}

std::string comment(std::string_view text) {
  std::string out = "# ";
  for (const char c : text) out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return out + "\n";
}

std::string knot_line(const world::TrackKnot& k) {
  return formatted(
      "  - {s_m: %.3f, curvature_per_m: %.9f, bank_deg: %.4f, width_left_m: %.3f, "
      "width_right_m: %.3f}\n",
      k.s_m, k.curvature_per_m, to_deg(k.bank_rad), k.width_left_m, k.width_right_m);
}

}  // namespace

std::string to_yaml(const world::TrackDescription& t, const std::vector<std::string>& remarks) {
  std::string out;
  for (const std::string& remark : remarks) out += comment(remark);
  out += "name: " + quoted(t.name) + "\n";
  out += formatted("length_m: %.4f\n", t.length_m);
  out += formatted("datum: {latitude_deg: %.9f, longitude_deg: %.9f, height_m: %.3f}\n",
                   t.datum_latitude_deg, t.datum_longitude_deg, t.datum_height_m);
  out += formatted("start: {x_m: %.4f, y_m: %.4f, yaw_deg: %.6f}\n", t.start_x_m, t.start_y_m,
                   to_deg(t.start_yaw_rad));
  if (t.pit)
    out += formatted(
        "pit: {entry_s_m: %.3f, exit_s_m: %.3f, offset_m: %.3f, width_m: %.3f, "
        "speed_limit_mps: %.3f}\n",
        t.pit->entry_s_m, t.pit->exit_s_m, t.pit->offset_m, t.pit->width_m, t.pit->speed_limit_mps);
  out += "knots:\n";
  for (const world::TrackKnot& k : t.knots) out += knot_line(k);
  return out;
}

}  // namespace pitwall::track_file
