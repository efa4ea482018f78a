// Fuel that an engine must have burnt, by its speed and its throttle: what a car knows that
// measures neither level nor flow.
//   in     engine speed, throttle and whether it runs, with the time of each sample
//   out    litres used since the first sample
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

namespace pitwall::rules {

inline constexpr double kFuelDensity_kgpl = 0.745;

struct EngineSample {
  double speed_rpm = kUnset, throttle = kUnset;
  bool running = false;
};
double fuel_flow_lps(const EngineSample& sample);

class FuelUse {
 public:
  static constexpr double kIdle_lph = 3.0;
  static constexpr Duration kGap = seconds(2);

  void receive(const EngineSample& sample, Instant sampled);
  double used_l() const { return used_l_; }

 private:
  double used_l_ = 0.0, flow_lps_ = 0.0;
  std::optional<Instant> newest_;
};

}  // namespace pitwall::rules
