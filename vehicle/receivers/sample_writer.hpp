// Output stage of every receiver decoder: sets unit and time (on the car's clock) of a sample,
// appends it to its list and counts it.
//   in     stream, GPS time of validity, arrival, the sample without `unit` and `at`
//   out    appended to SensorInput; a sample whose list is full counts in `overflows`
//   invariants
//          no sample is refused for its stamp: localization checks the stamps
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/receivers/counters.hpp"
#include "vehicle/receivers/gps_clock.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::receivers {

class SampleWriter {
 public:
  SampleWriter(std::uint8_t unit, Duration least_delay) : unit_(unit), clock_(least_delay) {}

  template <class List, class Sample>
  void write(Stream stream, gnss::GpsTime valid, Instant arrival, Sample sample, List& list,
             world::SensorInput& out) {
    const Placed placed = clock_.place(stream, valid, arrival);
    ++counters_.stamps[static_cast<std::size_t>(placed.flaw)];
    ++counters_.samples[static_cast<std::size_t>(stream)];
    counters_.clock_steps = clock_.steps();
    sample.at = placed.at;
    append(sample, list, out);
  }

  // The receiver status is stamped with its arrival, because it is valid even if the receiver's
  // time is wrong.
  void write(Instant arrival, world::ReceiverHealth health, world::SensorInput& out) {
    ++counters_.health;
    health.at = arrival;
    append(health, out.receivers, out);
  }

  void write(gnss::GpsTime gps, double utc_offset_s, Instant arrival, world::SensorInput& out) {
    static_cast<void>(out.times.push(
        {.unit = unit_, .received = arrival, .gps_ns = gps.ns, .utc_offset_s = utc_offset_s}));
  }

  Counters& counters() { return counters_; }
  const Counters& counters() const { return counters_; }

 private:
  template <class List, class Sample>
  void append(Sample& sample, List& list, world::SensorInput& out) {
    sample.unit = unit_;
    if (!list.push(sample)) ++out.overflows;
  }

  std::uint8_t unit_;
  GpsClock clock_;
  Counters counters_;
};

}  // namespace pitwall::receivers
