// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/outcome.hpp"

#include <cmath>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::bench {
namespace {

constexpr double kStands_mps = 0.3;

}  // namespace

void follow(Outcome& outcome, const VehiclePlace& now) {
  if (has_contact(outcome)) return;
  outcome.last = now;
  if (!outcome.nearest || now.wall_gap_m < outcome.nearest->wall_gap_m) outcome.nearest = now;
}

std::string to_text(const CarContact& contact) {
  const std::string cause = contact.is_caused && contact.is_caused_by_other ? "both cars"
                            : contact.is_caused                             ? "this car"
                            : contact.is_caused_by_other                    ? contact.with
                                                                            : "neither";
  return formatted("contact with %s, %s, at %.2f s, s %.0f m, closing at %.1f m/s; caused by %s",
                   contact.with.c_str(), traffic::name_of(contact.kind), contact.at.seconds(),
                   contact.s_m, contact.closing_mps, cause.c_str());
}

std::string to_text(const Outcome& outcome) {
  if (!outcome.last) return {};
  const VehiclePlace& last = *outcome.last;
  if (last.contact) {
    return formatted("the car hit the wall on the %s at %.2f s, s %.0f m, at %.1f m/s",
                     last.left ? "left" : "right", last.at.seconds(), last.s_m, last.speed_mps);
  }
  const VehiclePlace& nearest = *outcome.nearest;
  const std::string speed =
      last.speed_mps < kStands_mps ? "stands" : formatted("drives %.1f m/s", last.speed_mps);
  return formatted(
      "at the end the car %s, %.2f m from its line; nearest to a wall %.2f m, at %.2f s",
      speed.c_str(), std::abs(last.cross_track_m), nearest.wall_gap_m, nearest.at.seconds());
}

}  // namespace pitwall::bench
