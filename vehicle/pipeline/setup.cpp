// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/setup.hpp"

#include <array>
#include <optional>
#include <utility>

#include "vehicle/autonomy/planning/line_speeds.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::pipeline {
namespace {

using world::LegalRange;

constexpr double kPercent = 100.0;

std::optional<Problem> illegal_rates(const CarParams& p) {
  const double tick_s = p.rates.tick.seconds();
  return world::first_illegal(
      std::array{LegalRange{"rates.tick_s", tick_s, 0.005, 0.02},
                 LegalRange{"rates.planning_s", p.rates.planning.seconds(), tick_s, 0.2}});
}

// The middle of the car keeps half its width from a wall.
std::optional<Problem> illegal_width(const CarParams& p) {
  if (auto problem = world::first_illegal(kCarRanges, p)) return problem;
  const double half_m = 0.5 * p.width_m;
  return world::first_illegal(std::array{
      LegalRange{"planning.line.wall_clearance_m", p.planning.line.wall_clearance_m, half_m, 10.0},
      LegalRange{"planning.stop.clearance_m", p.planning.stop_path.clearance_m, half_m, 10.0}});
}

// What control and the supervisor may ask for must be what the frame gate lets pass: else the gate
// stops a car that does what its parameters say. Their slews are compared where the file is read.
std::optional<Problem> refused_by_gate(const CarParams& p) {
  const safety::GateParams& gate = p.gate;
  const safety::SupervisorParams& s = p.supervisor;
  const control::LongitudinalParams& l = p.control.longitudinal;
  return world::first_illegal(std::array{
      LegalRange{"control.longitudinal.brake_max_kpa", l.brake_max_kpa, 0.0, gate.brake_max_kpa},
      LegalRange{"control.longitudinal.throttle_max (percent)", l.throttle_max * kPercent, 0.0,
                 gate.throttle_max_percent},
      LegalRange{"safety.supervisor.safe_stop.brake_max_kpa", s.safe_stop.brake_max_kpa, 0.0,
                 gate.brake_max_kpa},
      LegalRange{"safety.supervisor.safe_stop.hold_kpa", s.safe_stop.hold_kpa, 0.0,
                 gate.brake_max_kpa},
      LegalRange{"safety.gate.gear_max", static_cast<double>(gate.gear_max), control::kGears, 8.0},
      LegalRange{"safety.gate.command_age_max_s", gate.command_age_max.seconds(),
                 p.rates.tick.seconds(), 0.2},
      // Shorter than a stop from top speed, and the car would let go of the brake while it moves.
      LegalRange{"safety.supervisor.faults.bus_dead_disarm_s", s.faults.bus_dead_disarm.seconds(),
                 p.planning.line.speed_max_mps / s.safe_stop.decel_without_plan_mps2, 60.0},
      LegalRange{"safety.supervisor.steering_ratio", s.steering_ratio, p.outbound.steering_ratio,
                 p.outbound.steering_ratio}});
}

envelope::SteeringLimit steering_of(const CarParams& p) {
  return {
      .limits = angles_of(p), .car = p.control.steering.bicycle, .share = p.planning.steer_share};
}

}  // namespace

steering::AngleLimits angles_of(const CarParams& p) {
  static_assert(steering::kAngleRows == safety::kSteerRows);
  steering::AngleLimits out;
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = {p.gate.steer[i].speed_mps,
              from_deg(p.gate.steer[i].motor_deg) / p.outbound.steering_ratio};
  return out;
}

envelope::EnvelopeParams envelope_of(const CarParams& p, const world::TrackMap& track,
                                     std::optional<double> tyre_c) {
  auto out = planning::envelope_of(p.planning.line, track, steering_of(p));
  if (tyre_c) out.friction = envelope::on_tyres(out.friction, *tyre_c);
  return out;
}

Result<Setup, Problem> prepare(const CarParams& params, const world::TrackDescription& track,
                               const world::RacelineBank* bank) {
  if (auto problem = illegal_rates(params)) return Unexpected{*problem};
  if (auto problem = illegal_width(params)) return Unexpected{*problem};
  if (auto problem =
          world::first_illegal(gateway::kOutboundRanges, params.outbound, "gateway.outbound."))
    return Unexpected{*problem};
  auto map = world::TrackMap::build(track);
  if (!map) return Unexpected{map.error()};
  auto datum = localization::Datum::at(map->datum_latitude_deg(), map->datum_longitude_deg(),
                                       map->datum_height_m());
  if (!datum) return Unexpected{datum.error()};
  auto localization = localization::checked(params.localization);
  if (!localization) return Unexpected{localization.error()};
  auto tracking = tracking::checked(params.tracking);
  if (!tracking) return Unexpected{tracking.error()};
  auto line = planning::prepare(params.planning, *map, bank, steering_of(params));
  if (!line) return Unexpected{line.error()};
  auto others = planning::prepare_others(params.planning, *map, bank, steering_of(params));
  if (!others) return Unexpected{others.error()};
  auto pit = planning::pit_line(*map, params.planning.line, *line, steering_of(params));
  if (!pit) return Unexpected{pit.error()};
  auto gains = control::prepare(params.control);
  if (!gains) return Unexpected{gains.error()};
  if (auto problem = refused_by_gate(params)) return Unexpected{*problem};
  CarParams checked = params;
  checked.localization = *localization;
  return Setup{checked,          *std::move(map),    *datum,
               *std::move(line), *std::move(others), *std::move(pit),
               *gains,           angles_of(params)};
}

}  // namespace pitwall::pipeline
