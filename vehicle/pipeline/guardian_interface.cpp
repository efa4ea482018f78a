// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/guardian_interface.hpp"

namespace pitwall::pipeline {

guardian::Params guardian_params(const CarParams& params) {
  const localization::Params& located = params.localization;
  guardian::Params out;
  for (std::size_t i = 0; i < world::kGnssUnits; ++i) {
    const localization::UnitParams& unit = located.units[i];
    out.reckoning.units[i] = {.x_m = unit.antenna.x_m,
                              .y_m = unit.antenna.y_m,
                              .z_m = unit.antenna.z_m,
                              .baseline_yaw_rad = unit.baseline_yaw_rad};
  }
  out.reckoning.bicycle = located.bicycle;
  out.reckoning.steering_ratio = params.outbound.steering_ratio;
  out.following = safety::following_of(params.supervisor);
  out.following.gate = params.gate;
  out.gate = params.gate;
  return out;
}

void publish(const Setup& setup, const Car& car, const Outputs& out, const Run& run, Instant now,
             GuardianRecord& reported) {
  guardian::CarRecord& record = reported.record;
  record.run = run.id;
  ++record.sequence;
  record.at = now;
  record.mode = out.chosen.mode;
  record.armed = out.chosen.actuate;
  record.sends = !out.quiet;
  record.reset = run.reset;
  record.barred = run.barred;
  record.finished = false;
  record.ego = out.ego;
  record.learned = car.learned;
  record.tyre_c = world::coldest_c(out.received.signals.tyre_temperature_c, now);
  record.datum = {setup.track.datum_latitude_deg(), setup.track.datum_longitude_deg(),
                  setup.track.datum_height_m()};
  if (!car.plan.ever || car.plan.at == reported.judged) return;
  reported.judged = car.plan.at;
  const world::Trajectory& stop = car.plan.output.stop;
  reported.verdict = guardian::check_stop({}, stop, out.ego, setup.track);
  if (reported.verdict == guardian::StopVerdict::kGood)
    record.stop = stop;
  else
    ++reported.refused;
}

GuardianView view_of(const guardian::Status& status, std::uint64_t run, Instant now) {
  GuardianView view;
  const bool alive = now - status.at <= guardian::kStatusAgeMax;
  view.drives = alive && guardian::drives(status.mode);
  view.stopped = status.latched && status.run == run;
  view.drove_from = status.drove_from;
  view.drove_until = status.drove_until;
  view.counters = status.counters;
  view.command = status.command;
  return view;
}

bool ended_armed(const guardian::CarRecord& record) {
  return record.run != 0 && ((record.armed && !record.finished) || record.barred);
}

void finish(GuardianRecord& reported) {
  const world::Mode mode = reported.record.mode;
  ++reported.record.sequence;
  reported.record.finished = mode == world::Mode::kDisarmed || mode == world::Mode::kStandby ||
                             mode == world::Mode::kHalted;
}

}  // namespace pitwall::pipeline
