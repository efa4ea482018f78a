// Estimate of the fuel in the tank of a car that does not measure it: the fuel loaded, less the
// fuel that its engine must have burnt. Good to about a tenth; shown as an estimate, and never used
// instead of a measurement.
//   in     litres in the tank as an operator entered them; engine speed, throttle and whether it
//          runs, with the time of each sample
//   out    litres left, litres used since the first sample
//   invariants
//          Willans line: flow = indicated torque x speed / (efficiency x heating value x density),
//          where indicated torque is that of full throttle times the share of the throttle;
//          a running engine burns kIdle_lph at least
//          between two samples the mean of both flows counts; over a gap longer than kGap it is the
//          greater one, so that fuel burnt without samples is not underestimated
//   units  litres, rpm, throttle 0 .. 1
//   errors a sample with a value that is not a number is ignored
//   source L. Guzzella, C. Onder, Introduction to Modeling and Control of Internal Combustion
//          Engine Systems (2010), 2.5; torque by speed and throttle from the public dyno sheet of
//          the AV-21's engine, friction added
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

struct EngineSample {
  double speed_rpm = kUnset, throttle = kUnset;
  bool running = false;
};
double fuel_flow_lps(const EngineSample& sample);

class FuelEstimate {
 public:
  static constexpr double kIdle_lph = 3.0;
  static constexpr Duration kGap = seconds(2);

  void loaded(double litres);
  void receive(const EngineSample& sample, Instant sampled);

  double level_l() const;  // at least zero; unset if no level was entered
  double used_l() const { return used_l_; }

 private:
  double loaded_l_ = kUnset, used_when_loaded_l_ = 0.0, used_l_ = 0.0;
  double flow_lps_ = 0.0;
  std::optional<Instant> newest_;
};

}  // namespace pitwall::state
