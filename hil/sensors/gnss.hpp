// Model of one GNSS receiver with two antennas: the solutions of satellites and inertial unit at an
// epoch.
//   in     the ground truth, the errors common to all receivers (Sky), the errors of the unit, its
//          faults
//   out    samples without unit and time
//   invariants
//          position error = wander common to both units + wander of the unit + white noise; each
//          part scales with the standard deviation of the solution type. The reported deviation is
//          that value with an error of about a tenth, in single precision
//   frames geodetic WGS 84 at the datum; velocity and heading as in BESTVEL and HEADING2
//   source README.md beside this file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <GeographicLib/LocalCartesian.hpp>
#include <array>
#include <cstdint>

#include "hil/plant/plant.hpp"
#include "hil/sensors/gauss_markov.hpp"
#include "hil/sensors/streams.hpp"
#include "hil/sensors/unit_fault.hpp"
#include "hil/sensors/unit_params.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::sensors {

struct GnssState {
  std::array<Noise, kUnitStreams> noise;
  GaussMarkov<3> position;
  GaussMarkov<1> heading, claim;  // claim: error of the reported deviations
  GaussMarkov<3> attitude;        // of the inertial solution: roll, pitch, heading
  bool aligned = false;
  world::GnssPosition last_position;
  bool has_last_position = false;

  Noise& of(UnitStream stream) { return noise[static_cast<std::size_t>(stream)]; }
};

struct Sky {
  GaussMarkov<3> wander;  // errors of satellites, atmosphere and base station
  double seconds = 0.0;   // since the start; corrections arrive once a second
};

GnssState make_gnss(std::uint64_t seed, std::size_t unit);

world::GnssPosition measure_position(const UnitParams& params, const SolutionFault& fault,
                                     const GeographicLib::LocalCartesian& datum,
                                     const plant::Truth& truth, const Sky& sky, double period_s,
                                     GnssState& state);
world::GnssVelocity measure_velocity(const UnitParams& params, const SolutionFault& fault,
                                     const plant::Truth& truth, GnssState& state);
world::GnssHeading measure_heading(const UnitParams& params, const SolutionFault& fault,
                                   const plant::Truth& truth, double period_s, GnssState& state);
world::InsAttitude measure_attitude(const UnitParams& params, const SolutionFault& fault,
                                    const plant::Truth& truth, double period_s, GnssState& state);

}  // namespace pitwall::sensors
