// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/opponent_mapper.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::pipeline {
namespace {

using telemetry::field;
using telemetry::FieldIndex;
using telemetry::Group;

struct OpponentFields {
  Group group;
  FieldIndex identity, station, offset, speed, age, position_sigma;
};

constexpr std::array kOpponentFields{
    OpponentFields{Group::kOpponent1, field("opponent_1.identity"), field("opponent_1.station"),
                   field("opponent_1.offset"), field("opponent_1.speed"), field("opponent_1.age"),
                   field("opponent_1.position_sigma")},
    OpponentFields{Group::kOpponent2, field("opponent_2.identity"), field("opponent_2.station"),
                   field("opponent_2.offset"), field("opponent_2.speed"), field("opponent_2.age"),
                   field("opponent_2.position_sigma")},
    OpponentFields{Group::kOpponent3, field("opponent_3.identity"), field("opponent_3.station"),
                   field("opponent_3.offset"), field("opponent_3.speed"), field("opponent_3.age"),
                   field("opponent_3.position_sigma")},
    OpponentFields{Group::kOpponent4, field("opponent_4.identity"), field("opponent_4.station"),
                   field("opponent_4.offset"), field("opponent_4.speed"), field("opponent_4.age"),
                   field("opponent_4.position_sigma")}};

struct Ranked {
  double distance_m = kUnset;
  const world::Opponent* car = nullptr;
};

void put_opponent(const OpponentFields& f, const world::Opponent& car, Instant now,
                  telemetry::Snapshot& snapshot) {
  constexpr std::uint32_t kNumbers = 254;
  telemetry::Values& v = snapshot.values;
  v[f.identity] = static_cast<double>((car.id - 1) % kNumbers + 1);
  v[f.station] = car.s_m;
  v[f.offset] = car.n_m;
  v[f.speed] = car.speed_mps;
  v[f.age] = (now - car.measured_at).seconds();
  v[f.position_sigma] = position_sigma_m(car);
  snapshot.at(f.group) = now;
}

}  // namespace

void map_opponents(const TelemetryInputs& in, telemetry::Snapshot& snapshot) {
  FixedVector<Ranked, world::kOpponentsMax> ranked;
  const double length_m = in.setup.track.length_m();
  for (const world::Opponent& car : in.out.opponents.cars) {
    const double gap_m = std::remainder(car.s_m - in.out.place.s_m, length_m);
    if (std::isfinite(gap_m)) (void)ranked.push({std::abs(gap_m), &car});
  }
  std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.car->id < b.car->id;
  });
  for (std::size_t i = 0; i < std::min(ranked.size(), kOpponentFields.size()); ++i)
    put_opponent(kOpponentFields[i], *ranked[i].car, in.now, snapshot);
}

}  // namespace pitwall::pipeline
