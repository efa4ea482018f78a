// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/slip.hpp"

#include <cmath>

namespace pitwall::state {
namespace {

double excess(double driven_mps, double against_mps) {
  if (std::isnan(driven_mps) || std::isnan(against_mps)) return kUnset;
  if (!(against_mps >= kSlipSpeed_mps)) return 0.0;
  return (driven_mps - against_mps) / against_mps;
}

}  // namespace

double Slip::worst() const { return std::fmax(rear_front, rear_gnss); }  // of the one that is there

Slip slip_of(const WheelSpeeds& wheels, double gnss_mps) {
  const double front_mps = (wheels.front_left_mps + wheels.front_right_mps) / 2.0;
  const double rear_mps = (wheels.rear_left_mps + wheels.rear_right_mps) / 2.0;
  return {.rear_front = excess(rear_mps, front_mps), .rear_gnss = excess(rear_mps, gnss_mps)};
}

}  // namespace pitwall::state
